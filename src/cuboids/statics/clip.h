// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/clip_convex.h"
#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// The part of a convex polygon (counter-clockwise or not, of 2 corners or more) behind a plane.
inline std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Plane& plane) {
  return clip_convex(polygon, [&](const Vec3& p) { return plane.signed_distance(p); });
}

/// Least distance between two parallel lines that hold a convex polygon between them.
inline double width_of(const std::vector<Vec3>& polygon, const Vec3& normal) {
  if (polygon.size() < 3) return 0.0;
  double least = INFINITY;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    if (length == 0.0) continue;
    const Vec3 inward = normal.cross(edge) / length;
    double low = 0.0, high = 0.0;
    for (const Vec3& p : polygon) {
      low = std::min(low, inward.dot(p - polygon[i]));
      high = std::max(high, inward.dot(p - polygon[i]));
    }
    least = std::min(least, high - low);
  }
  return least;
}

}  // namespace unseen::cuboids
