// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/rgbd_frame.h"

namespace unseen::cuboids {

/// What one viewpoint proves about space. Works on a depth image, and on a fused cloud by a range image of all
/// directions around its viewpoint.
class DepthView {
 public:
  enum class Space {
    free,     ///< in front of a measured surface by more than 3σ
    surface,  ///< within 3σ of it
    hidden,   ///< behind it
    missing,  ///< no measurement there
    outside   ///< of the picture
  };

  /// `noise` is σ of the depth at 1 m; it grows with the square of the depth (disparity sensors).
  DepthView(const RgbdFrame& frame, const RigidTransform& T_world_camera, double noise);

  Space at(const Vec3& world) const;
  /// The measured points in a box, or within `margin` (m) of it.
  std::vector<Vec3> measured_in(const OrientedBox& box, double margin) const;
  /// m: σ of a measurement at that place.
  double sigma(const Vec3& world) const;
  Vec3 viewpoint() const { return T_world_camera_.translation; }
  /// m: spacing of neighbouring measurements at that place, across the ray.
  double spacing(const Vec3& world) const;

 private:
  struct Pixel {
    double depth = 0;  ///< of the point asked for: along the axis, or from the viewpoint
    int index = -1;    ///< into depth_, −1 = outside
  };
  Pixel project(const Vec3& world) const;
  Vec3 point_at(int x, int y) const;

  Camera camera_;  ///< width 0 = all directions
  int width_ = 0, height_ = 0;
  RigidTransform T_world_camera_, T_camera_world_;
  std::vector<float> depth_;
  double noise_ = 0;
};

}  // namespace unseen::cuboids
