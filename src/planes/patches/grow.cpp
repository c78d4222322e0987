// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "planes/patches/patches.h"

namespace unseen::planes {
namespace {

constexpr double kFirstFit = 12.0;    // cells of a region before its own fit counts
constexpr double kRefitGrowth = 1.3;  // the running fit is renewed when a region has grown by this factor
constexpr int kMostFailures = 10;     // what was in so many regions that are no surfaces starts none: clutter would be grown from each of its voxels

double least_points(const Space& space) { return space.is_2d() ? 5 : 8; }

/// True if a region is a surface, not a blob or a thread.
bool is_planar(const Moments& m, const PlaneFit& fit, const Space& space, double edge) {
  const double spread = space.is_2d() ? fit.spread_u : fit.spread_v;
  return m.count >= least_points(space) && spread > 1.5 * fit.rms && fit.spread_u > 0.6 * edge &&
         spread > 0.3 * edge;
}

/// What growing asks of a voxel, in one cache line.
struct alignas(64) Cell {
  Vec3 mean, normal;
  double reach, tolerance;
};
static_assert(sizeof(Cell) == 64);

}  // namespace

CellSets grow_regions(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle,
                      Context& context) {
  LargeVector<std::pair<double, int>> order;  // variation, voxel
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (!cells.normal[i].isZero()) order.emplace_back(cells.variation[i], static_cast<int>(i));
  std::sort(order.begin(), order.end());

  const double cos_angle = std::cos(angle);
  LargeVector<Cell> cell;
  cell.reserve(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i)
    cell.push_back({grid.moments[i].mean, cells.normal[i], cells.reach[i], cells.tolerance[i]});
  VoxelSet open = grid.empty_set();  // neither taken by a region nor in the one that grows
  for (const auto& [variation, i] : order) grid.insert(open, i);
  std::vector<std::uint8_t> failures(grid.size(), 0);
  CellSets regions;
  std::size_t visited = 0;
  for (const auto& [variation, seed] : order) {
    if ((++visited & 0xfff) == 0) context.progress(static_cast<double>(visited) / order.size());
    if (!grid.contains(open, seed) || failures[seed] >= kMostFailures) continue;
    std::vector<int> region = {seed};
    Moments sum = grid.moments[seed];
    Vec3 normal = cells.normal[seed], center = sum.mean;
    double next_fit = kFirstFit;
    grid.erase(open, seed);
    for (std::size_t at = 0; at < region.size(); ++at) {
      const Cell& from = cell[region[at]];
      grid.for_neighbours(region[at], voxels_within(cells, grid, region[at]), open, [&](int i) {
        const Cell& to = cell[i];
        const double reach = std::max(from.reach, to.reach);
        if ((to.mean - from.mean).squaredNorm() > reach * reach) return;
        if (std::abs(to.normal.dot(normal)) < cos_angle) return;
        if (std::abs(normal.dot(to.mean - center)) > to.tolerance) return;
        grid.erase(open, i);
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
    if (sum.count < least_points(space)) {
      for (const int i : region) grid.insert(open, i);
      continue;
    }
    // What the early fit let in and the final one does not explain goes back to the pool.
    const PlaneFit fit = fit_plane(sum, space);
    std::vector<int> kept;
    Moments rest;
    for (const int i : region) {
      grid.insert(open, i);
      if (std::abs(fit.normal.dot(cell[i].mean - sum.mean)) <= cell[i].tolerance &&
          std::abs(cell[i].normal.dot(fit.normal)) >= cos_angle) {
        kept.push_back(i);
        rest += grid.moments[i];
      }
    }
    if (kept.empty() || !is_planar(rest, fit_plane(rest, space), space, grid.edge)) {
      for (const int i : region) failures[i] = std::min<std::uint8_t>(failures[i] + 1, kMostFailures);
      continue;
    }
    for (const int i : kept) grid.erase(open, i);
    std::sort(kept.begin(), kept.end());
    regions.push_back(std::move(kept));
  }
  return regions;
}

}  // namespace unseen::planes
