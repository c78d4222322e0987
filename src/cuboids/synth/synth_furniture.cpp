// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>

#include "cuboids/synth/synth_builder.h"

namespace unseen::cuboids {
namespace {

/// A seat on two side boards with a back fixed to its rear edge, facing `heading` (rad; −π/2 = towards the front).
void add_chair(SynthBuilder& builder, const Vec2& place, double heading) {
  const Mat3 turn = Eigen::AngleAxisd(heading + kPi / 2, Vec3::UnitZ()).toRotationMatrix();
  const auto put = [&](const Vec3& foot, const Vec3& size) {
    return builder.stand(turn * foot + Vec3(place.x(), place.y(), 0), size, heading + kPi / 2);
  };
  for (const double side : {-1.0, 1.0}) put({side * 0.17, 0, 0}, {0.06, 0.32, 0.40});
  const int seat = put({0, 0, 0.40}, {0.44, 0.42, 0.05});
  const int back = put({0, 0.235, 0.41}, {0.40, 0.05, 0.45});
  builder.fix(seat, back);
}

}  // namespace

/// Boards on short uprights, with books in rows and in a pile.
SynthFrame build_bookshelf(SynthBuilder& builder, Random& random) {
  const Vec3 board(0.95, 0.30, 0.035), upright(0.08, 0.26, 0.29);
  double z = 0;
  builder.stand({0, 0, z}, board);
  for (int level = 0; level < 3; ++level) {
    z += board.z();
    for (const double side : {-1.0, 1.0}) builder.stand({side * 0.40, 0, z}, upright);
    double x = level == 0 ? -0.28 : level == 1 ? -0.02 : -0.25;
    for (int book = 0; book < 3; ++book) {
      const Vec3 size(random.uniform(0.055, 0.08), random.uniform(0.16, 0.22), random.uniform(0.18, 0.24));
      builder.stand({x + size.x() / 2, random.uniform(-0.03, 0.01), z}, size);
      x += size.x();
    }
    z += upright.z();
    builder.stand({0, 0, z}, board);
  }
  z += board.z();
  builder.stand({-0.15, 0, z}, {0.26, 0.20, 0.06});
  builder.stand({-0.13, 0.01, z + 0.06}, {0.20, 0.15, 0.05});
  return {1.5, 2.0, true};
}

/// A board on a cabinet and a side board; on it a screen on a foot, books, a printer and a mug; a computer below.
SynthFrame build_desk(SynthBuilder& builder) {
  constexpr double kLegs = 0.69, kTop = 0.72;
  builder.stand({-0.42, 0, 0}, {0.42, 0.58, kLegs});
  builder.stand({0.60, 0, 0}, {0.06, 0.58, kLegs});
  builder.stand({0, 0, kLegs}, {1.34, 0.66, kTop - kLegs});
  builder.stand({0.35, 0.05, 0}, {0.18, 0.42, 0.42});
  const int foot = builder.stand({0.02, 0.14, kTop}, {0.30, 0.24, 0.025});
  const int column = builder.stand({0.02, 0.18, kTop + 0.025}, {0.08, 0.06, 0.32});
  const int screen = builder.stand({0.02, 0.12, kTop + 0.10}, {0.52, 0.06, 0.33});
  builder.fix(foot, column);
  builder.fix(column, screen);
  builder.stand({0.47, 0.08, kTop}, {0.28, 0.30, 0.17});
  builder.stand({0.46, 0.10, kTop + 0.17}, {0.20, 0.16, 0.05});
  builder.stand({-0.45, 0.05, kTop}, {0.22, 0.29, 0.06}, radians(12.0));
  builder.stand({-0.44, 0.06, kTop + 0.06}, {0.16, 0.23, 0.05}, radians(-8.0));
  builder.stand({-0.14, -0.20, kTop}, {0.09, 0.09, 0.11});
  return {1.5, 2.0, true};
}

/// A seat on four legs; the back is fixed to the rear edge of the seat.
SynthFrame build_four_legged_chair(SynthBuilder& builder) {
  for (const double x : {-0.17, 0.17})
    for (const double y : {-0.14, 0.14}) builder.stand({x, y, 0}, {0.065, 0.065, 0.41});
  const int seat = builder.stand({0, 0, 0.41}, {0.46, 0.45, 0.055});
  const int back = builder.stand({0, 0.25, 0.42}, {0.42, 0.05, 0.48});
  builder.fix(seat, back);
  return {1.35, 2.0, true};
}

/// An office chair: base, column, seat, back and arms. All of it hangs on the column, beyond its footprint.
SynthFrame build_pedestal_chair(SynthBuilder& builder) {
  const int base = builder.stand({0, 0, 0}, {0.52, 0.52, 0.06});
  const int column = builder.stand({0, 0, 0.06}, {0.09, 0.09, 0.34});
  const int seat = builder.stand({0, 0, 0.40}, {0.46, 0.46, 0.07});
  const int back = builder.stand({0, 0.26, 0.41}, {0.42, 0.06, 0.52});
  builder.fix(base, column);
  builder.fix(column, seat);
  builder.fix(seat, back);
  for (const double side : {-1.0, 1.0}) {
    const int arm = builder.stand({side * 0.255, -0.02, 0.41}, {0.05, 0.30, 0.23});
    builder.fix(seat, arm);
  }
  return {1.35, 2.0, true};
}

/// A board held between two end boards, which are its legs, and two chairs at each long side.
SynthFrame build_table(SynthBuilder& builder) {
  const int top = builder.stand({0, 0, 0.68}, {1.40, 0.80, 0.05});
  for (const double side : {-1.0, 1.0}) {
    const int leg = builder.stand({side * 0.74, 0, 0}, {0.08, 0.70, 0.74});
    builder.fix(top, leg);
  }
  for (const double x : {-0.36, 0.36}) {
    add_chair(builder, {x, -0.72}, kPi / 2);
    add_chair(builder, {x, 0.72}, -kPi / 2);
  }
  return {1.6, 2.0, true};
}

/// Two boards fixed to a wall, with things on them, over a chest.
SynthFrame build_shelf(SynthBuilder& builder) {
  constexpr double kWall = 0.40;
  builder.set_wall(kWall);
  const int upper = builder.stand({-0.10, kWall - 0.13, 1.08}, {0.90, 0.26, 0.04});
  const int lower = builder.stand({0.15, kWall - 0.13, 0.72}, {0.70, 0.26, 0.04});
  builder.fix_to_wall(upper);
  builder.fix_to_wall(lower);
  builder.stand({-0.40, 0.26, 1.12}, {0.16, 0.14, 0.20});
  builder.stand({-0.13, 0.25, 1.12}, {0.22, 0.15, 0.08});
  builder.stand({0.18, 0.26, 1.12}, {0.13, 0.12, 0.16});
  builder.stand({0.00, 0.26, 0.76}, {0.15, 0.14, 0.18});
  builder.stand({0.30, 0.25, 0.76}, {0.24, 0.15, 0.07});
  builder.stand({0, 0.12, 0}, {0.90, 0.36, 0.42});
  builder.stand({-0.25, 0.10, 0.42}, {0.26, 0.20, 0.10});
  return {1.55, 1.5, true};
}

}  // namespace unseen::cuboids
