// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <string>

#include "unseen/collision/types.h"
#include "unseen/core/random.h"

namespace unseen::collision {

inline constexpr double kC = 0.72, kBallRadius = 0.0335, kGravity = 9.81;

/// How a ball is thrown over a floor at z = 0 and from where it is filmed; world with z up, degrees.
struct View {
  Vec3 camera = {0, -2.2, 0.7};
  double pitch = 0, roll = 0;  ///< looks down; turned clockwise
  Vec3 start, velocity;
  double tilt = 0;             ///< of the floor, about the viewing direction
  int bounces = 1, frames = 55;
  double fps = 60, size_noise = 0.02;  ///< share
};

inline Mat3 world_to_camera(const View& view) {
  Mat3 level;
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return Eigen::AngleAxisd(radians(view.roll), Vec3::UnitZ()) * Eigen::AngleAxisd(radians(view.pitch), Vec3::UnitX()) * level;
}

/// A ball and something fixed that was not seen yet.
inline Shot ball_and(const std::string& fixed, double radius, double fps, double focal) {
  Shot shot;
  shot.name = "shot";
  shot.fps = fps;
  shot.camera.camera = {focal, focal, 639.5, 359.5, 1280, 720};
  shot.bodies.resize(2);
  shot.bodies[0].name = "ball";
  shot.bodies[0].radius = radius;
  shot.bodies[1].name = fixed;
  shot.bodies[1].shape = Shape::fixed;
  return shot;
}

/// Sightings, each off by 0.3 px, of a ball without friction; the vertical is not told.
inline Shot filmed(const View& view, int seed) {
  constexpr double kNoise = 0.3;
  Shot shot = ball_and("floor", kBallRadius, view.fps, 1108.5);
  const Mat3 R = world_to_camera(view);
  const Vec3 n = Eigen::AngleAxisd(radians(view.tilt), Vec3::UnitY()) * Vec3::UnitZ(), g(0, 0, -kGravity);
  Random random(static_cast<std::uint64_t>(seed));
  Vec3 p = view.start, v = view.velocity;
  double since = 0.0;  // s, of p and v
  int left = view.bounces;
  for (int frame = 0; frame < view.frames; ++frame) {
    double t = frame / view.fps - since;
    const double height = n.dot(p) - kBallRadius, speed = n.dot(v), pull = n.dot(g);
    const double hit = (-speed - std::sqrt(std::max(0.0, speed * speed - 2.0 * pull * height))) / pull;
    if (left > 0 && t > hit) {
      p += hit * v + 0.5 * hit * hit * g;
      v += hit * g;
      v -= (1.0 + kC) * n.dot(v) * n;
      since += hit, t -= hit, --left;
    }
    const Vec3 seen = R * (p + t * v + 0.5 * t * t * g - view.camera);
    const Vec2 pixel = shot.camera.camera.project(seen) + kNoise * Vec2(random.normal(), random.normal());
    const double radius = shot.camera.camera.fx * kBallRadius / seen.z() * (1.0 + view.size_noise * random.normal());
    if (pixel.x() > 0 && pixel.x() < 1280 && pixel.y() > 0 && pixel.y() < 720) shot.observations.push_back({frame, pixel, radius, 0});
  }
  return shot;
}

inline View towards_the_camera(int bounces) { return {{0, -2.2, 0.7}, 12, 0, {-0.3, 3.0, 1.2}, {0.2, -2.2, 0}, 0, bounces, bounces == 1 ? 55 : 85}; }

}  // namespace unseen::collision
