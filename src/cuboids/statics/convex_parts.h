// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/statics/interface.h"

namespace unseen::cuboids {

/// Convex solids that fill a closed mesh without overlapping: one if it is convex, else its box cut along the planes of
/// its faces. Throws std::invalid_argument if it is not closed, has no volume, or would fall into more than 256 parts.
std::vector<ConvexSolid> convex_parts(const TriangleMesh& mesh);

/// Volume (m³, negative if inside out) and centre of mass of a closed mesh of even density.
struct MassCenter {
  double volume = 0;
  Vec3 center = Vec3::Zero();
};
MassCenter mass_center(const TriangleMesh& mesh);

}  // namespace unseen::cuboids
