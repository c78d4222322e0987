// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/patches.h"
#include "planes/weighted.h"

namespace unseen::planes {
namespace {

constexpr double kStray = 5.0;      // times the median distance of a region's points: noise leaves hardly any of them there
constexpr double kNoStray = 0.05;   // of the tolerance: what is nearer is never a stray
constexpr double kFewInVoxel = 2;     // points: more are something that stands there
constexpr int kStrayRounds = 3;

double distance_of_voxel(const Moments& m, const PlaneFit& fit, const Vec3& center) { return std::abs(fit.normal.dot(m.mean - center)); }

/// How far from a region's plane its voxels may lie.
double farthest_of(const VoxelGrid& grid, const std::vector<int>& region, const PlaneFit& fit, const Vec3& center) {
  std::vector<std::pair<double, double>> distances;
  distances.reserve(region.size());
  for (const int i : region) {
    const Moments& m = grid.moments[i];
    const double within = std::sqrt(std::max(0.0, fit.normal.dot(m.scatter * fit.normal) / m.count));
    distances.emplace_back(std::hypot(distance_of_voxel(m, fit, center), within), m.count);
  }
  return std::max(kStray * weighted_quantile(std::move(distances), 0.5), kNoStray * grid.tolerance);
}

/// Those of a region's voxels that hold a point or two far from its plane with no other such voxel beside them.
std::vector<int> strays_of(const VoxelGrid& grid, const Space& space, const std::vector<int>& region) {
  const Moments all = sum_of(grid, region);
  const PlaneFit fit = fit_plane(all, space);
  const double farthest = farthest_of(grid, region, fit, all.mean);
  std::vector<int> far, strays;
  for (const int i : region)
    if (distance_of_voxel(grid.moments[i], fit, all.mean) > farthest) far.push_back(i);
  for (const int i : far) {
    bool alone = grid.moments[i].count <= kFewInVoxel;
    if (!alone) continue;
    grid.for_neighbours(i, 1, [&](int k) { alone = alone && (k == i || !std::binary_search(far.begin(), far.end(), k)); });
    if (alone) strays.push_back(i);
  }
  return strays;
}

}  // namespace

CellSets drop_strays(const VoxelGrid& grid, const Space& space, CellSets regions, const Context& context) {
  parallel_blocks(context, regions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (int round = 0; round < kStrayRounds; ++round) {
        const std::vector<int> strays = strays_of(grid, space, regions[r]);
        if (strays.empty()) break;
        std::erase_if(regions[r], [&](int i) { return std::binary_search(strays.begin(), strays.end(), i); });
      }
  });
  return regions;
}

}  // namespace unseen::planes
