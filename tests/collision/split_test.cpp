// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Which flight the sightings next to an impact belong to.
#include <gtest/gtest.h>

#include "unseen/collision/collision.h"

namespace unseen::collision {
namespace {

constexpr double kFps = 24, kRestitution = 0.6, kMassRatio = 1.5, kRadius = 0.05, kMeeting = 30.0;

/// Two labelled balls seen without noise, in closed form; their impact comes `late` frames after frame 30, and `after` frames show what follows.
Shot two_balls(double late, int after) {
  Shot shot;
  shot.fps = kFps;
  shot.camera.camera = {1100, 1100, 639.5, 359.5, 1280, 720};
  shot.down = Vec3::UnitY();
  const Vec3 normal = Vec3(1, 0.2, 0.1).normalized(), center(0.0, 0.1, 2.5);
  const std::array<Vec3, 2> before = {Vec3(1.6, 0.3, 0.2), Vec3(-1.1, 0.5, -0.1)};
  const Vec3 impulse = (1 + kRestitution) * normal.dot(before[0] - before[1]) / (1 + 1 / kMassRatio) * normal;  // on the first ball's mass 1
  const std::array<Vec3, 2> then = {before[0] - impulse, before[1] + impulse / kMassRatio};
  for (int body = 0; body < 2; ++body) {
    Body b;
    b.name = body == 0 ? "a" : "b";
    b.shape = Shape::sphere;
    b.radius = kRadius;
    shot.bodies.push_back(b);
    for (int frame = 22; frame <= kMeeting + after; ++frame) {
      const double t = (frame - kMeeting - late) / kFps;
      const auto o = static_cast<std::size_t>(body);
      const Vec3 p = center + (body == 0 ? -kRadius : kRadius) * normal + t * (t < 0 ? before[o] : then[o]) + 0.5 * shot.gravity * t * t * *shot.down;
      Sighting s;
      s.body = body;
      s.frame = frame;
      s.pixel = shot.camera.camera.project(p);
      shot.observations.push_back(s);
    }
  }
  return shot;
}

TEST(Split, SightingsNextToTheImpactFindTheirFlight) {
  for (const double late : {0.04, 0.1, 0.3, 0.9, 0.97})
    for (const int after : {3, 8}) {
      Context context;
      const Reconstruction r = reconstruct(two_balls(late, after), {}, context);
      ASSERT_TRUE(r.impacts.size() == 1 && r.mass_ratio) << late << " " << after;
      EXPECT_NEAR(r.impacts[0].frame, kMeeting + late, 0.02) << late << " " << after;
      EXPECT_NEAR(r.impacts[0].restitution.value, kRestitution, 0.01) << late << " " << after;
      EXPECT_NEAR(r.mass_ratio->value, kMassRatio, 0.015) << late << " " << after;
    }
}

}  // namespace
}  // namespace unseen::collision
