// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "planes/patches/patches.h"

namespace unseen::planes {

/// What a region is cut into.
struct Pieced {
  CellSets pieces;    ///< voxels; none if no cut is clearly better than one plane
  bool bent = false;  ///< at shallow bends, or into facets, as waves on a plane could also leave them
};

/// The pieces of a region; none if no cut is clearly better than one plane. The two sides of the straight cut that leaves the
/// least squared error to a plane each, or the islands on it, if these leave less. Where the region is bent several times, as facades along a
/// zigzag, no single cut is better: then the cut at the sharpest bend.
Pieced best_cut(const VoxelGrid& grid, const Space& space, const std::vector<int>& region);

}  // namespace unseen::planes
