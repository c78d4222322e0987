// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/synth/synth_builder.h"

namespace unseen::cuboids {
namespace {

constexpr SynthFrame kTableTop = {0.75, 0.45, true};

}  // namespace

/// Wide boxes on narrow ones, so that each wide one hides what carries it.
SynthFrame build_tower(SynthBuilder& builder, int boxes, Random& random) {
  const int count = boxes > 0 ? boxes : 6;
  double z = 0;
  for (int i = 0; i < count; ++i) {
    const bool wide = i % 2 == 0;
    const double width = wide ? random.uniform(0.24, 0.30) : random.uniform(0.15, 0.19);
    const double depth = wide ? random.uniform(0.20, 0.24) : random.uniform(0.13, 0.16);
    const double height = random.uniform(0.06, 0.10);
    const double slack = wide ? 0.012 : 0.025;
    builder.stand({random.uniform(-slack, slack), random.uniform(-slack, slack), z}, {width, depth, height});
    z += height;
  }
  return kTableTop;
}

/// Packages one upon the other, each turned against the one below.
SynthFrame build_twisted(SynthBuilder& builder, int boxes, Random& random) {
  const int count = boxes > 0 ? boxes : 5;
  double z = 0, yaw = random.uniform(-0.3, 0.3);
  for (int i = 0; i < count; ++i) {
    const Vec3 size(random.uniform(0.20, 0.27), random.uniform(0.13, 0.18), random.uniform(0.05, 0.09));
    builder.stand({random.uniform(-0.015, 0.015), random.uniform(-0.015, 0.015), z}, size, yaw);
    z += size.z();
    yaw += (random.uniform() < 0.5 ? -1.0 : 1.0) * random.uniform(radians(20.0), radians(50.0));
  }
  return kTableTop;
}

/// Courses of bricks, every second one shifted by three tenths of a brick. Each brick stands back or forth by some
/// millimetres, for nobody tells apart bricks in one plane by their depth.
SynthFrame build_running_bond(SynthBuilder& builder, int boxes, Random& random) {
  const int count = boxes > 0 ? boxes : 18;
  const int columns = count <= 6 ? 2 : count <= 18 ? 3 : 7;
  const Vec3 brick(0.20, 0.12, 0.09);
  const double shift = 0.3 * brick.x();
  for (int i = 0; i < count; ++i) {
    const int course = i / columns, column = i % columns;
    const double start = -0.5 * (columns * brick.x() + shift) + (course % 2 == 1 ? shift : 0.0);
    builder.stand({start + (column + 0.5) * brick.x(), random.uniform(-0.015, 0.015), course * brick.z()}, brick);
  }
  return count > 18 ? SynthFrame{1.3, 1.0, true} : kTableTop;
}

/// Two decks reach out from piers beyond what these can bear alone; a span lies on their tips.
SynthFrame build_bridge(SynthBuilder& builder, bool counterweights) {
  constexpr double kPier = 0.15, kDeck = 0.04;
  for (const double side : {-1.0, 1.0}) builder.stand({side * 0.30, 0, 0}, {0.10, 0.17, kPier});
  for (const double side : {-1.0, 1.0}) builder.stand({side * 0.24, 0, kPier}, {0.40, 0.15, kDeck});
  if (counterweights)
    for (const double side : {-1.0, 1.0}) builder.stand({side * 0.375, 0, kPier + kDeck}, {0.12, 0.12, 0.13});
  builder.stand({0, 0, kPier + kDeck}, {0.24, 0.12, 0.035});
  SynthFrame frame = kTableTop;
  frame.stands = counterweights;
  return frame;
}

/// Planks that lean on the upper edges of a block, from three sides.
SynthFrame build_leaning(SynthBuilder& builder) {
  const Vec3 block(0.30, 0.26, 0.26);
  builder.stand({0, 0, 0}, block);
  const auto lean = [&](double heading, double slope_deg, double aside, const Vec3& plank) {
    const Vec3 level(std::cos(heading), std::sin(heading), 0), across(-level.y(), level.x(), 0);
    const double half = std::abs(level.x()) > 0.5 ? block.x() / 2 : block.y() / 2;
    const double slope = radians(slope_deg);
    builder.lean(-(half + block.z() / std::tan(slope)) * level + aside * across, heading, slope, plank);
  };
  lean(kPi, 52, 0.03, {0.40, 0.13, 0.03});
  lean(0.0, 47, 0.04, {0.42, 0.16, 0.035});
  lean(kPi / 2, 58, 0.02, {0.37, 0.12, 0.03});
  builder.stand({0, 0.03, block.z()}, {0.15, 0.12, 0.09});
  return kTableTop;
}

/// Four planks in a ring, each with one end on the ground and the other on the next plank. Both are tilted, so that they
/// meet in a point, where an edge of the underside crosses an edge of the upper side.
SynthFrame build_cyclic(SynthBuilder& builder) {
  const Vec3 plank(0.50, 0.07, 0.035);
  constexpr double kFoot = 0.25, kAside = 0.12;
  const double slope = std::asin(plank.z() / (2 * kAside - plank.y()));
  for (int i = 0; i < 4; ++i) {
    const double heading = i * kPi / 2;
    const Mat3 turn = Eigen::AngleAxisd(heading, Vec3::UnitZ()).toRotationMatrix();
    builder.lean(turn * Vec3(-kFoot, -kAside, 0), heading, slope, plank);
  }
  for (int i = 0; i < 4; ++i) builder.touch(i, (i + 1) % 4);
  return kTableTop;
}

/// A block between two pillars that nothing presses against it: it cannot be held by friction, and falls.
SynthFrame build_jam(SynthBuilder& builder) {
  for (const double side : {-1.0, 1.0}) builder.stand({side * 0.18, 0, 0}, {0.14, 0.18, 0.32});
  builder.stand({0, -0.01, 0.17}, {0.22, 0.13, 0.09});
  SynthFrame frame = kTableTop;
  frame.stands = false;
  return frame;
}

}  // namespace unseen::cuboids
