// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// m, the largest gap between two boxes along any axis that can separate them; negative = by how much they overlap.
double separation(const OrientedBox& a, const OrientedBox& b);

/// Corners of the intersection of two boxes; none if they do not overlap.
std::vector<Vec3> intersection_corners(const OrientedBox& a, const OrientedBox& b);

/// A rectangle of a box: side `sign` (±1) of axis k.
struct BoxFace {
  Vec3 center, normal, u, v;  ///< u and v are unit; normal points outward
  double half_u = 0, half_v = 0;
};
BoxFace face_of(const OrientedBox& box, int k, double sign);

/// Half the extent of a box along a unit direction.
double half_extent(const OrientedBox& box, const Vec3& direction);

}  // namespace unseen::cuboids
