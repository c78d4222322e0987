// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/surfaces/point_graph.h"

namespace unseen::cuboids {

/// A flat piece of surface.
struct Face {
  Plane plane;                  ///< the normal points toward the viewpoint
  Vec3 center = Vec3::Zero();   ///< mean of its points
  double area = 0;              ///< m²
  double length = 0, width = 0; ///< m, standard deviations of its points within the plane
  double rms = 0;               ///< distance of its points to the plane, in σ
  std::vector<int> points;
};

struct Faces {
  std::vector<Face> faces;
  std::vector<int> face_of_point;  ///< −1 = none
};

/// Flat regions grown over links within points of equal non-negative `group`; flattest seeds first. A region of fewer
/// than `min_points` is none. What lies between regions falls to the one whose plane it lies on.
/// A region goes by the normal of its seed until it is `first_width` σ wide: far away σ is many pixels, and a fit to a few
/// pixels would tilt the plane off its surface.
Faces grow_faces(std::span<const Vec3> points, const PointGraph& graph, std::span<const int> group,
                 const Vec3& viewpoint, int min_points, double first_width = 0.0);

}  // namespace unseen::cuboids
