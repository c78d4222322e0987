// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "planes/scan/voxels.h"

namespace unseen::planes {

/// What is known of the surface in each voxel, parallel to VoxelGrid::keys.
struct Cells {
  LargeVector<Vec3> normal;       ///< unit length, sign arbitrary; zero where no orientation is reliable
  LargeVector<double> variation;  ///< λ₀/(λ₀+λ₁+λ₂) of the neighbourhood, 0 = flat; 1 where there is no normal
  LargeVector<double> tolerance;  ///< m, the local scale: ρ, or more with an adaptive scale
  LargeVector<double> reach;      ///< m, how far apart neighbours may be: more than the scale where sampling is sparse
};

constexpr double kBeyondReach = 1.3;  ///< of the reach: no neighbours are asked for that are farther away

/// Reach of a voxel in voxels, times `factor` (≤ kBeyondReach).
inline int voxels_within(const Cells& cells, const VoxelGrid& grid, std::size_t voxel, double factor = 1.0) {
  return static_cast<int>(factor * cells.reach[voxel] / grid.edge);
}

/// What a voxel's normal says of a plane's: only a flat neighbourhood proves anything.
enum class NormalVerdict : std::int8_t { agrees, unknown, contradicts };
NormalVerdict compare_normal(const Cells& cells, std::size_t voxel, const Vec3& normal);

/// Estimates each voxel's normal by PCA over the smallest of the radii ρ, 2ρ, 4ρ, 8ρ (grid.edge = ρ/2) whose
/// neighbourhood is flat enough to have one; where there is none, from the input's own normals. Lets the grid's
/// neighbours be found within their reach.
Cells estimate_normals(VoxelGrid& grid, const Space& space, Context& context);

/// Local scale: grows with the distance to `viewpoint` beyond the median distance, or, without one, with the
/// local noise, up to four times ρ.
void adapt_tolerance(Cells& cells, const VoxelGrid& grid, const std::optional<Vec3>& viewpoint);

}  // namespace unseen::planes
