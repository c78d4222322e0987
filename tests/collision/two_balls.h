// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/collision/collision.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {

inline constexpr double kRestitution = 0.6, kMassRatio = 1.5, kRadius = 0.05, kMeeting = 30.0;

/// When two balls meet, and how they are seen.
struct Meeting {
  double late = 0.4;  ///< frames after frame 30
  int after = 8;      ///< frames seen after frame 30
  int from = 22;      ///< the first frame
  double fps = 24;
  Vec3 along = Vec3(1, 0.2, 0.1);  ///< of the impulse
  double noise = 0;                ///< px
  std::uint64_t seed = 1;
  double readout = 0;              ///< s, of a rolling shutter
};

/// Two labelled balls in closed form.
inline Shot two_balls(const Meeting& meeting) {
  Shot shot;
  shot.fps = meeting.fps;
  Random random(meeting.seed);
  shot.camera.camera = {1100, 1100, 639.5, 359.5, 1280, 720};
  shot.down = Vec3::UnitY();
  const Vec3 normal = meeting.along.normalized(), center(0.0, 0.1, 2.5);
  const std::array<Vec3, 2> before = {Vec3(1.6, 0.3, 0.2), Vec3(-1.1, 0.5, -0.1)};
  const Vec3 impulse = (1 + kRestitution) * normal.dot(before[0] - before[1]) / (1 + 1 / kMassRatio) * normal;  // on the first ball's mass 1
  const std::array<Vec3, 2> then = {before[0] - impulse, before[1] + impulse / kMassRatio};
  for (int body = 0; body < 2; ++body) {
    Body b;
    b.name = body == 0 ? "a" : "b";
    b.shape = Shape::sphere;
    b.radius = kRadius;
    shot.bodies.push_back(b);
    for (int frame = meeting.from; frame <= kMeeting + meeting.after; ++frame) {
      const auto o = static_cast<std::size_t>(body);
      const auto place = [&](double t) {
        return Vec3(center + (body == 0 ? -kRadius : kRadius) * normal + t * (t < 0 ? before[o] : then[o]) + 0.5 * shot.gravity * t * t * *shot.down);
      };
      double t = (frame - kMeeting - meeting.late) / meeting.fps;
      const double middle = t;  // when the middle row is read
      for (int round = 0; round < 8; ++round) t = middle + meeting.readout * ((shot.camera.camera.project(place(t)).y() + 0.5) / 720.0 - 0.5);
      const Vec3 p = place(t);
      Sighting s;
      s.body = body;
      s.frame = frame;
      s.pixel = shot.camera.camera.project(p) + meeting.noise * Vec2(random.normal(), random.normal());
      s.radius = shot.camera.camera.fx * kRadius / p.z() + meeting.noise * random.normal();
      shot.observations.push_back(s);
    }
  }
  return shot;
}

}  // namespace unseen::collision::test
