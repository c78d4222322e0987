// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/planes/synth.h"

namespace unseen::planes {

/// A scene without points: surfaces, frames, and where a scanner can stand.
struct SynthModel {
  TriangleMesh mesh;
  std::vector<Plane> planes;
  std::vector<int> frames, turned;
  std::vector<Mat3> axes;
  std::vector<Vec3> scanners;
  std::vector<std::array<Vec3, 2>> segments;  ///< floorplan: one a label
};

/// Puts a model together from polygons and boxes, given in scene coordinates and turned by the scene's yaw.
class SynthBuilder {
 public:
  explicit SynthBuilder(double yaw);  ///< rad

  /// A new orientation frame: the scene's, turned by `rotation`.
  int add_frame(const Mat3& rotation);
  /// A convex polygon. It gets a label of its own, or joins the plane of `label`. Returns its label.
  int add_polygon(const std::vector<Vec3>& corners, int frame, int label = -1);
  /// Four sides and the top of a box that stands on z = low.z: `pose` places it in the scene.
  void add_box(const Vec3& low, const Vec3& high, const RigidTransform& pose, int frame, bool turned);
  /// A vertical wall of `thickness`, both faces, ends open, from a to b (2D), with a door (0.9 m × 2.1 m)
  /// that starts `door` metres after a; door < 0: none.
  void add_wall(const Vec2& a, const Vec2& b, double low, double high, double thickness, double door);
  /// A line of a floor plan; its surface reaches from z = −1 to 1.
  void add_segment(const Vec2& a, const Vec2& b, int frame, bool turned);
  /// A closed outline of lines.
  void add_outline(const std::vector<Vec2>& corners, int frame, bool turned);
  void add_scanner(const Vec3& position) { model_.scanners.push_back(yaw_ * position); }

  SynthModel take() { return std::move(model_); }

 private:
  Mat3 yaw_;
  SynthModel model_;
};

/// Pose of furniture: turned by `angle` (rad) about the vertical, then moved to `position`.
RigidTransform upright_pose(const Vec3& position, double angle);

SynthModel make_lhouse(const SynthOptions& options);
SynthModel make_stairs(const SynthOptions& options);
SynthModel make_room(const SynthOptions& options);
SynthModel make_floorplan(const SynthOptions& options);
SynthModel make_building(const SynthOptions& options);

/// Points of a 3D model by ray casting, and of a floor plan along its lines, without outliers.
PointCloud scan_model(const SynthModel& model, const SynthOptions& options, Context& context);
PointCloud sample_floorplan(const SynthModel& model, const SynthOptions& options);

}  // namespace unseen::planes
