// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Share of the voxels of a box that are not proven free.
double filled_share(const DepthView& view, const OrientedBox& box, double voxel);

/// Greedy slabs (thesis, Section 4.3.1) within a box: the points of each slab, the best explanation first. Slabs share no voxel
/// and are filled at least to `fill`; points of slabs too small to tell are left out. An integral volume makes each
/// candidate cost the same.
std::vector<std::vector<int>> split_into_slabs(const Observation& seen, const DepthView& view, std::span<const int> points,
                                               const OrientedBox& box, double voxel, double fill);

}  // namespace unseen::cuboids
