// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <cmath>

#include "planes/patches/patches.h"
#include "planes/scan/weighted.h"

namespace unseen::planes {
namespace {

constexpr double kStray = 5.0;      // times the median distance of a region's points: noise leaves hardly any of them there
constexpr double kNoStray = 0.05;   // of the tolerance: what is nearer is never a stray
constexpr double kFewInVoxel = 2;     // points: more are something that stands there
constexpr int kStrayRounds = 3, kCoreRounds = 10;
constexpr double kFewestInQuarter = 12;  // points that a quarter's plane is fitted to
constexpr double kClearlyLess = 0.7;
constexpr std::size_t kMedianOf = 4096;  // voxels that tell a median

double distance_of_voxel(const Moments& m, const PlaneFit& fit, const Vec3& center) { return std::abs(fit.normal.dot(m.mean - center)); }

/// The median distance of a region's points from a plane, voxel by voxel.
double median_distance(const VoxelGrid& grid, const std::vector<int>& region, const PlaneFit& fit, const Vec3& center) {
  std::vector<std::pair<double, double>> distances;
  const std::size_t step = 1 + region.size() / kMedianOf;
  for (std::size_t r = 0; r < region.size(); r += step) {
    const Moments& m = grid.moments[region[r]];
    const double within = std::sqrt(std::max(0.0, fit.normal.dot(m.scatter * fit.normal) / m.count));
    distances.emplace_back(std::hypot(distance_of_voxel(m, fit, center), within), m.count);
  }
  return weighted_quantile(std::move(distances), 0.5);
}

/// How far from a region's plane its voxels may lie.
double farthest_of(const VoxelGrid& grid, const std::vector<int>& region, const PlaneFit& fit, const Vec3& center) {
  return std::max(kStray * median_distance(grid, region, fit, center), kNoStray * grid.tolerance);
}

/// The voxels whose plane has the least median distance: all of the region, or one of its quarters, if most of what does not belong is elsewhere.
std::vector<int> least_median_part(const VoxelGrid& grid, const Space& space, const std::vector<int>& region) {
  const Moments all = sum_of(grid, region);
  const PlaneFit fit = fit_plane(all, space);
  double least = median_distance(grid, region, fit, all.mean);
  std::vector<int> best = region;
  if (space.is_2d()) return best;
  std::array<std::vector<int>, 4> quarters;
  for (const int i : region) {
    const Vec3 d = grid.moments[i].mean - all.mean;
    quarters[(d.dot(fit.u) < 0 ? 0 : 1) + (d.dot(fit.v) < 0 ? 0 : 2)].push_back(i);
  }
  for (std::vector<int>& quarter : quarters) {
    const Moments sum = sum_of(grid, quarter);
    if (sum.count < kFewestInQuarter) continue;
    if (const double median = median_distance(grid, region, fit_plane(sum, space), sum.mean); median < kClearlyLess * least) least = median, best = std::move(quarter);
  }
  return best;
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

std::vector<int> core_of(const VoxelGrid& grid, const Space& space, const std::vector<int>& cells) {
  std::vector<int> core = least_median_part(grid, space, cells);
  for (int round = 0; round < kCoreRounds; ++round) {
    const Moments sum = sum_of(grid, core);
    const PlaneFit fit = fit_plane(sum, space);
    const double farthest = farthest_of(grid, cells, fit, sum.mean);
    std::vector<int> near;
    for (const int i : cells)
      if (distance_of_voxel(grid.moments[i], fit, sum.mean) <= farthest) near.push_back(i);
    if (near == core) break;
    core = std::move(near);
  }
  return core;
}

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
