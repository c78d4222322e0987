// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "report/triangulate.h"
#include "unseen/planes/types.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {

/// What is drawn of one plane: its triangles, or in 2D its segment (two vertices, no triangles).
struct Surface {
  std::vector<Vec3> vertices;  ///< metres, world
  std::vector<Triangle> triangles;
};

/// One a plane, in the order of the planes; empty where a plane has neither polygon nor segment.
std::vector<Surface> surfaces_of(const planes::Arrangement& arrangement);

/// What float32 cannot hold to a millionth of the scene's size (UTM coordinates) is stored relative to this
/// point: the middle of surfaces and points, m, rounded to whole metres. Zero for scenes near the origin.
Vec3 storage_offset(const std::vector<Surface>& surfaces, const PointSample& points);

}  // namespace unseen::report
