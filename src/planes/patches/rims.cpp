// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Where two planes meet, normals between theirs make a strip that is no plane of its own.
#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/patches/patches.h"

namespace unseen::planes {
namespace {

constexpr double kUnexplained = 0.1 + 1e-9;  // of a rim's points that other planes may leave unexplained
constexpr double kMostUnexplained = 0.5;     // the same where they explain the others better than its own plane
constexpr double kParallel = 3.0 * kPi / 180.0;
constexpr double kFarOff = 25.0;             // of its own squared error: what a parallel plane leaves of the other side of a thin wall, at least
constexpr double kWide = 1.5;                // of the tolerance: deviation across such a side, at least; strips of what is curved are narrower

}  // namespace

CellSets drop_rims(const VoxelGrid& grid, const Cells& cells, const Space& space, CellSets regions,
                   Context& context) {
  std::vector<Plane> planes;
  std::vector<double> size, points, width;  // width: a standard deviation, m
  std::vector<int> region_of(grid.size(), -1);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Moments m = sum_of(grid, regions[r]);
    const PlaneFit fit = fit_plane(m, space);
    planes.push_back({fit.normal, fit.normal.dot(m.mean)});
    size.push_back(space.is_2d() ? fit.spread_u : fit.spread_u * fit.spread_v);
    points.push_back(m.count);
    width.push_back(std::min(fit.spread_u, fit.spread_v));
    for (const int i : regions[r]) region_of[i] = static_cast<int>(r);
  }
  const std::vector<int> region_of_block = grid.labels_of_blocks(region_of);
  const auto squared_distances = [&](const Moments& m, int r) { return m.squared_distances(planes[r].normal, planes[r].offset); };
  const auto is_rim = [&](int r) {
    const auto no_other = [&](std::uint32_t block) {
      return region_of_block[block] == VoxelGrid::kNone || region_of_block[block] == r;
    };
    double unexplained = 0, own = 0, others = 0;  // points; squared distances of those explained
    double beside = 0, own_beside = 0, others_beside = 0;  // the same of those that a parallel plane explains
    for (const int i : regions[r]) {
      const Moments& m = grid.moments[i];
      double least = std::numeric_limits<double>::infinity();
      int last = r;
      bool parallel = false;
      grid.for_neighbours_unless(i, voxels_within(cells, grid, i, kBeyondReach), no_other, [&](int k) {
        const int o = region_of[k];
        if (o < 0 || o == r || o == last || size[o] <= size[r]) return;
        last = o;
        if (std::abs(planes[o].signed_distance(m.mean)) >= cells.tolerance[i]) return;
        if (const double d = squared_distances(m, o); d < least) least = d, parallel = line_angle(planes[o].normal, planes[r].normal) < kParallel;
      });
      if (std::isinf(least)) {
        unexplained += m.count;
        if (unexplained > kMostUnexplained * points[r]) return false;
      } else {
        own += squared_distances(m, r);
        others += least;
        if (parallel) beside += m.count, own_beside += squared_distances(m, r), others_beside += least;
      }
    }
    const bool other_side = width[r] > kWide * grid.tolerance && beside > 0.5 * points[r] && others_beside > kFarOff * own_beside;
    if (other_side) return false;
    return unexplained <= kUnexplained * points[r] || (unexplained <= kMostUnexplained * points[r] && others < own);
  };
  // Only larger regions explain a rim's points, so that each is judged by itself.
  std::vector<char> rim(regions.size());
  parallel_blocks(context, regions.size(), 1, [&](std::size_t r, std::size_t) { rim[r] = is_rim(static_cast<int>(r)); });
  CellSets kept;
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (!rim[r]) kept.push_back(std::move(regions[r]));
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace unseen::planes
