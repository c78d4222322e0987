// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/patches/patches.h"

namespace unseen::planes {

/// A region in pieces on two levels.
struct Islands {
  CellSets pieces;   ///< none if the region is not on two levels
  double error = 0;  ///< m², squared error that the two leave
};

/// The pieces (voxels) of a region on two parallel planes that are clearly apart and lie side by side, as a panel on a roof and windows in
/// a wall do: no straight cut parts them. `whole` and `fit` are the region's.
Islands islands_in(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit);

}  // namespace unseen::planes
