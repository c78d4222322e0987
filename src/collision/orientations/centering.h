// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// A body's silhouette, as a figure in the picture.
struct Figure {
  Vec2 centroid = Vec2::Zero();  ///< px
  double area = 0;               ///< px²
};

/// Draws silhouettes of one body.
class FigureMaker {
 public:
  FigureMaker(const Body& body, const std::string& source);

  /// `q` maps the file's axes to the camera, `center` is that of mass.
  Figure at(const Quat& q, const Vec3& center, const Camera& camera) const;

 private:
  Body body_;
  TriangleMesh mesh_;  ///< about the centre of mass; empty for a sphere
  bool convex_ = true;
};

/// Where a body is thought to be and how it is turned (principal axes to camera) at a point's time; false if that is not known.
using PoseOf = std::function<bool(const PointObservation& point, Vec3& center, Quat& q)>;

/// What regions tell of the projected centres of mass: their centroids less the offset that a body placed and turned like that has, and
/// the distance at which it would show the region's area. Points whose area does not go with the others' of their flight (bodies that
/// merge, or are covered in part) are left out. Points without a pose stay as they are.
std::vector<PointObservation> centered(const std::vector<PointObservation>& points, const Problem& problem,
                                       const std::array<FigureMaker, 2>& makers, const PoseOf& pose);

}  // namespace unseen::collision
