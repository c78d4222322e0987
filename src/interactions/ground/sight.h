// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// A camera that stands above the world's origin and looks along +y; if it looks straight up or down, the top of its picture is there.
struct View {
  Camera camera;
  RigidTransform T_world_camera;

  Vec3 center() const { return T_world_camera.translation; }
  /// Unit direction of a pixel in the world.
  Vec3 ray(const Vec2& pixel) const { return (T_world_camera.rotation * camera.unproject(pixel.x(), pixel.y(), 1.0)).normalized(); }
  Vec2 project(const Vec3& world) const { return camera.project(T_world_camera.inverse() * world); }
};

View view_of(const Camera& camera, const Ground& ground);

/// Joints below this confidence say nothing of where they are.
inline constexpr double kSeen = 0.3;

/// What one detection says in the world. A joint's point p costs (p − camera)ᵀ·information·(p − camera): its confidence times the squared
/// distance to the ray of its pixel, m². Zero for joints that are not seen.
struct Sight {
  int frame = 0;
  Pixels pixels = Pixels::Zero();
  PerJoint confidence = PerJoint::Zero();
  std::array<Vec3, kJoints> rays;  ///< unit
  std::array<Mat3, kJoints> information;
  double depth = 0;  ///< m, rough: of a torso of usual length; 0 = not known
  std::array<bool, kJoints> behind_others = {};  ///< joints that are not seen for somebody stands in front of them
  std::optional<Pose> local;  ///< world axes, pelvis at the origin
};

/// One person's detections, by frame.
std::vector<Sight> sights_of(const Take& take, int person, const View& view);

}  // namespace unseen::interactions
