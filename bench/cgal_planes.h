// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::bench {

/// What a method made of N points.
struct Detection {
  std::vector<Plane> planes;
  std::vector<int> plane_of_point;  ///< N indices into planes, -1 = none
  double seconds = 0;               ///< detection alone
  double normals_seconds = 0;  ///< estimating normals, where the method needs them and the input has none
};

/// Points with normals as CGAL's detectors want them, relative to the first point (survey coordinates are
/// large). Normals that are missing or not of unit length are estimated: PCA, 12 neighbours.
struct OrientedPoints {
  std::vector<Vec3> positions, normals;
  double normals_seconds = 0;
};
OrientedPoints orient(const std::vector<Vec3>& positions, const std::vector<Vec3f>& normals);

/// Peers from CGAL 5.5, untuned. `scale` is the distance tolerance; normals may be 25° off, and a plane has
/// at least 50 points, in each. Region growing: 12 nearest neighbours (the default), seeds by fit quality;
/// planes are least-squares fits.
Detection region_growing(const OrientedPoints& points, double scale);
/// The same, then Shape_regularization::Planes::regularize_planes with its defaults.
Detection regularized_region_growing(const OrientedPoints& points, double scale);
/// Schnabel et al. 2007: probability 0.01, cluster distance 2·scale, seeded.
Detection efficient_ransac(const OrientedPoints& points, double scale);

}  // namespace unseen::bench
