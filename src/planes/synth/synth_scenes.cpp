// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/synth/synth_builder.h"

namespace unseen::planes {
namespace {

const RigidTransform kInPlace;

Mat3 turn_about(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

/// Two wings of 3 m × 9 m that meet in an L, roofs of exactly 45°, on level ground, seen from around.
SynthModel make_lhouse(const SynthOptions& options) {
  SynthBuilder b(radians(options.yaw));
  const int roof_a = b.add_frame(turn_about(Vec3::UnitY(), radians(45)));
  const int roof_b = b.add_frame(turn_about(Vec3::UnitX(), radians(45)));
  b.add_polygon({{-6, -6, 0}, {15, -6, 0}, {15, 15, 0}, {-6, 15, 0}}, 0);
  b.add_polygon({{0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {1.5, 0, 4.5}, {0, 0, 3}}, 0);
  b.add_polygon({{0, 0, 0}, {0, 9, 0}, {0, 9, 3}, {0, 0, 3}}, 0);
  const int north = b.add_polygon({{0, 9, 0}, {9, 9, 0}, {9, 9, 3}, {0, 9, 3}}, 0);
  b.add_polygon({{0, 9, 3}, {3, 9, 3}, {1.5, 9, 4.5}}, 0, north);
  b.add_polygon({{9, 6, 0}, {9, 9, 0}, {9, 9, 3}, {9, 7.5, 4.5}, {9, 6, 3}}, 0);
  b.add_polygon({{3, 6, 0}, {9, 6, 0}, {9, 6, 3}, {3, 6, 3}}, 0);
  b.add_polygon({{3, 0, 0}, {3, 6, 0}, {3, 6, 3}, {3, 0, 3}}, 0);
  b.add_polygon({{0, 0, 3}, {0, 9, 3}, {1.5, 9, 4.5}, {1.5, 0, 4.5}}, roof_a);
  const int east = b.add_polygon({{3, 0, 3}, {3, 6, 3}, {1.5, 7.5, 4.5}, {1.5, 0, 4.5}}, roof_a);
  b.add_polygon({{1.5, 7.5, 4.5}, {3, 9, 3}, {1.5, 9, 4.5}}, roof_a, east);
  b.add_polygon({{3, 9, 3}, {9, 9, 3}, {9, 7.5, 4.5}, {1.5, 7.5, 4.5}}, roof_b);
  b.add_polygon({{3, 6, 3}, {9, 6, 3}, {9, 7.5, 4.5}, {1.5, 7.5, 4.5}}, roof_b);
  for (const Vec3& p : {Vec3(11, -3, 7), Vec3(-4, 4, 7), Vec3(5, 13, 7), Vec3(13, 8, 7)}) b.add_scanner(p);
  return b.take();
}

/// Eight steps of 0.28 m × 0.17 m between a floor and a landing, beside a wall.
SynthModel make_stairs(const SynthOptions& options) {
  constexpr int kSteps = 8;
  constexpr double kTread = 0.28, kRise = 0.17, kWidth = 1.5;
  SynthBuilder b(radians(options.yaw));
  b.add_polygon({{-2.5, 0, 0}, {0, 0, 0}, {0, kWidth, 0}, {-2.5, kWidth, 0}}, 0);
  for (int k = 0; k < kSteps; ++k) {
    const double x = k * kTread, z = k * kRise, end = k + 1 < kSteps ? x + kTread : x + 1.5;
    b.add_polygon({{x, 0, z}, {x, kWidth, z}, {x, kWidth, z + kRise}, {x, 0, z + kRise}}, 0);
    b.add_polygon({{x, 0, z + kRise}, {end, 0, z + kRise}, {end, kWidth, z + kRise}, {x, kWidth, z + kRise}},
                  0);
  }
  const double end = (kSteps - 1) * kTread + 1.5;
  b.add_polygon({{-2.5, kWidth, 0}, {end, kWidth, 0}, {end, kWidth, 3.6}, {-2.5, kWidth, 3.6}}, 0);
  b.add_polygon({{end, 0, 0}, {end, kWidth, 0}, {end, kWidth, 3.6}, {end, 0, 3.6}}, 0);
  b.add_scanner({-1.8, 0.6, 1.7});
  b.add_scanner({end - 0.6, 0.7, kSteps * kRise + 1.5});
  return b.take();
}

/// 6 m × 5 m × 2.7 m with a wardrobe and a bed along its walls, and a desk and a cabinet that are turned.
SynthModel make_room(const SynthOptions& options) {
  SynthBuilder b(radians(options.yaw));
  const double w = 6, d = 5, h = 2.7, turn = radians(options.turn);
  b.add_polygon({{0, 0, 0}, {w, 0, 0}, {w, d, 0}, {0, d, 0}}, 0);
  b.add_polygon({{0, 0, h}, {0, d, h}, {w, d, h}, {w, 0, h}}, 0);
  b.add_polygon({{0, 0, 0}, {w, 0, 0}, {w, 0, h}, {0, 0, h}}, 0);
  b.add_polygon({{w, 0, 0}, {w, d, 0}, {w, d, h}, {w, 0, h}}, 0);
  b.add_polygon({{w, d, 0}, {0, d, 0}, {0, d, h}, {w, d, h}}, 0);
  b.add_polygon({{0, d, 0}, {0, 0, 0}, {0, 0, h}, {0, d, h}}, 0);
  b.add_box({0.05, 3.2, 0}, {0.65, 4.8, 2.1}, kInPlace, 0, false);
  b.add_box({3.8, 3.0, 0}, {5.8, 4.6, 0.5}, kInPlace, 0, false);
  if (options.share > 0) {
    const int frame = b.add_frame(turn_about(Vec3::UnitZ(), turn));
    b.add_box({-0.8, -0.4, 0}, {0.8, 0.4, 0.75}, upright_pose({1.6, 1.2, 0}, turn), frame, true);
    b.add_box({-0.25, -0.25, 0}, {0.25, 0.25, 1.1}, upright_pose({4.9, 1.2, 0}, turn), frame, true);
  }
  for (const Vec3& p : {Vec3(3.1, 2.3, 1.65), Vec3(1.2, 2.6, 1.6), Vec3(3.4, 0.5, 1.6), Vec3(2.4, 4.3, 1.7)})
    b.add_scanner(p);
  return b.take();
}

/// Outer walls of 0.3 m, inner ones of 0.2 m and 0.1 m with gaps for doors, and a turned piece of furniture.
SynthModel make_floorplan(const SynthOptions& options) {
  SynthBuilder b(radians(options.yaw));
  const auto rectangle = [&](double x0, double y0, double x1, double y1) {
    b.add_outline({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 0, false);
  };
  rectangle(0, 0, 10, 8);
  rectangle(0.3, 0.3, 9.7, 7.7);
  rectangle(5.0, 0.8, 5.2, 3.0);  // 0.2 m, doors of 0.9 m between
  rectangle(5.0, 3.9, 5.2, 7.2);
  rectangle(0.8, 4.5, 2.6, 4.6);  // 0.1 m
  rectangle(3.5, 4.5, 4.6, 4.6);
  rectangle(6.4, 4.9, 9.2, 5.1);
  if (options.share > 0) {
    const double turn = radians(options.turn);
    const int frame = b.add_frame(turn_about(Vec3::UnitZ(), turn));
    const auto at = [&](double x, double y) {
      return Vec2(2.6 + std::cos(turn) * x - std::sin(turn) * y,
                  2.3 + std::sin(turn) * x + std::cos(turn) * y);
    };
    b.add_outline({at(-1, -0.6), at(1, -0.6), at(1, 0.6), at(-1, 0.6)}, frame, true);
  }
  return b.take();
}

}  // namespace unseen::planes
