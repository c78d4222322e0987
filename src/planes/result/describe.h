// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/arrange.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// The result's planes, directions and frames from the final model, with outlines and areas. `sums` holds the
/// moments of the points that each plane explains; planes of fewer than three, or that lie off them, are left out. Returns the
/// result's index of each of the model's planes (−1 = left out).
std::vector<int> describe_planes(const Model& model, const std::vector<Moments>& sums, const VoxelGrid& grid, const Cells& cells,
                                 const Space& space, Arrangement& result, const Context& context);

/// Sets a plane's number of points and their rms distance.
void count_points(const Moments& points, const Space& space, ArrangedPlane& plane);

/// Pairs of directions at an angle of Θ, and how many pairs of planes they make.
void find_relations(const AngleSet& angles, Arrangement& result);

/// Coplanar planes, equal steps, distances between planes that face each other, equal lengths. Coordinates come in steps of `rounding` (m).
void find_second_order(Arrangement& result, double rounding = 0.0);

/// "floor", "ceiling", "wall", … from the up direction: +z, or the normal of the dominant floor.
void tag_planes(Arrangement& result);

}  // namespace unseen::planes
