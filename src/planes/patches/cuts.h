// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <utility>
#include <vector>

#include "planes/patches/patches.h"

namespace unseen::planes {

/// The two sides (voxels) of the straight cut through a region that leaves the least squared error to a plane each; both empty if none is clearly
/// better than one plane. Where the region is bent several times, as facades along a zigzag, no single cut is: then the cut at the sharpest bend.
std::pair<std::vector<int>, std::vector<int>> best_cut(const VoxelGrid& grid, const Space& space, const std::vector<int>& region);

}  // namespace unseen::planes
