// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "planes/patches/patches.h"

namespace unseen::planes {

/// Which way points face.
struct Slope {
  Eigen::Vector2d slope;  ///< against a plane, along its axes
  double error;           ///< m², squared, about their own plane
};

/// None of points in a line, which tell no slope across it. `plane`: against which.
std::optional<Slope> slope_of(const Moments& points, const PlaneFit& plane);

/// A region in facets.
struct Facets {
  CellSets pieces;   ///< none if the region is not made of facets
  double error = 0;  ///< m², squared error that they leave
};

/// The facets (voxels) of a region whose blocks face few directions, little turned against each other, as floors do that are drained to a gully: no straight
/// cut parts them. What bends evenly, as a sagging floor, faces as many directions as it has blocks, and has none. `whole` and `fit` are the region's.
Facets facets_in(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit);

}  // namespace unseen::planes
