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

/// What to subtract from world coordinates that float32 cannot hold to a millionth of the scene's size: the scene's
/// middle, rounded to whole metres; else zero.
Vec3 offset_of(const std::vector<Surface>& surfaces, const PointSample& points);

}  // namespace unseen::report
