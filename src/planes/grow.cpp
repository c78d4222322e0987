// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include "planes/patches.h"

namespace unseen::planes {
namespace {

constexpr double kRefitGrowth = 1.3;  // the running fit is renewed when a region has grown by this factor

/// True if a region is a surface, not a blob or a thread.
bool is_planar(const Moments& m, const PlaneFit& fit, const Space& space, double edge) {
  const double spread = space.is_2d() ? fit.spread_u : fit.spread_v;
  return m.count >= (space.is_2d() ? 5 : 8) && spread > 1.5 * fit.rms && fit.spread_u > 0.6 * edge &&
         spread > 0.3 * edge;
}

}  // namespace

CellSets grow_regions(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle,
                      Context& context) {
  std::vector<int> order;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (!cells.normal[i].isZero()) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return cells.variation[a] < cells.variation[b]; });

  const double cos_angle = std::cos(angle);
  constexpr int kFree = -1, kTaken = -2;
  std::vector<int> state(grid.size(), kFree);  // or the seed of the region that saw it last
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (cells.normal[i].isZero()) state[i] = kTaken;
  CellSets regions;
  std::size_t visited = 0;
  for (const int seed : order) {
    if ((++visited & 0xfff) == 0) context.progress(static_cast<double>(visited) / order.size());
    if (state[seed] == kTaken) continue;
    std::vector<int> region = {seed};
    Moments sum = grid.moments[seed];
    Vec3 normal = cells.normal[seed], center = sum.mean;
    double next_fit = 3.0 * std::max<double>(4, 1);  // cells
    state[seed] = seed;
    for (std::size_t at = 0; at < region.size(); ++at) {
      const int cell = region[at];
      const Vec3 from = grid.moments[cell].mean;
      grid.for_neighbours(cell, voxels_within(cells, grid, cell), [&](int i) {
        if (state[i] == seed || state[i] == kTaken) return;
        const Vec3& to = grid.moments[i].mean;
        const double reach = std::max(cells.reach[cell], cells.reach[i]);
        if ((to - from).squaredNorm() > reach * reach) return;
        if (std::abs(cells.normal[i].dot(normal)) < cos_angle) return;
        if (std::abs(normal.dot(to - center)) > cells.tolerance[i]) return;
        state[i] = seed;
        region.push_back(i);
        sum += grid.moments[i];
      });
      if (region.size() >= next_fit) {
        const PlaneFit fit = fit_plane(sum, space);
        // A thin start may fit any plane through its line: trust the fit once it has width.
        if ((space.is_2d() ? fit.spread_u : fit.spread_v) > 2.0 * fit.rms) normal = fit.normal;
        center = sum.mean;
        next_fit = std::max<double>(region.size() + 1, kRefitGrowth * region.size());
      }
    }
    // What the early fit let in and the final one does not explain goes back to the pool.
    const PlaneFit fit = fit_plane(sum, space);
    std::vector<int> kept;
    Moments rest;
    for (const int i : region)
      if (std::abs(fit.normal.dot(grid.moments[i].mean - sum.mean)) <= cells.tolerance[i] &&
          std::abs(cells.normal[i].dot(fit.normal)) >= cos_angle) {
        kept.push_back(i);
        rest += grid.moments[i];
      }
    if (kept.empty() || !is_planar(rest, fit_plane(rest, space), space, grid.edge)) continue;
    for (const int i : kept) state[i] = kTaken;
    std::sort(kept.begin(), kept.end());
    regions.push_back(std::move(kept));
  }
  return regions;
}

}  // namespace unseen::planes
