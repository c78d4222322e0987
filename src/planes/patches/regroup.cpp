// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Merging of regions: planes must not stop at gaps in the data.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "planes/patches/patches.h"

namespace unseen::planes {
namespace {

constexpr double kMergeLoss = 1.2;       // a merge may raise either part's rms by this factor

struct Region {
  std::vector<int> cells;
  Moments moments;
  PlaneFit fit;
  std::set<int> adjacent;
};

/// Pairs of regions with voxels within reach of each other; some are there twice.
std::vector<std::pair<int, int>> adjacent_regions(const VoxelGrid& grid, const Cells& cells,
                                                  const std::vector<Region>& regions, const std::vector<int>& region_of,
                                                  const Context& context) {
  std::vector<std::vector<int>> beside(regions.size());
  const std::vector<int> region_of_block = grid.labels_of_blocks(region_of);
  parallel_blocks(context, regions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      std::vector<int>& found = beside[r];
      const auto no_other = [&](std::uint32_t block) {
        return region_of_block[block] == VoxelGrid::kNone || region_of_block[block] == static_cast<int>(r);
      };
      for (const int i : regions[r].cells)
        grid.for_neighbours_unless(i, voxels_within(cells, grid, i), no_other, [&](int k) {
          const int o = region_of[k];
          if (o < 0 || o == static_cast<int>(r)) return;
          if (!found.empty() && found.back() == o) return;
          if ((grid.moments[k].mean - grid.moments[i].mean).norm() > cells.reach[i]) return;
          found.push_back(o);
        });
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
    }
  });
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const int o : beside[r]) pairs.emplace_back(static_cast<int>(r), o);
  return pairs;
}

/// The larger of the factors by which a common plane raises the rms of either; infinite beyond `angle`.
double merge_loss(const Region& a, const Region& b, const Space& space, double angle, double floor) {
  if (line_angle(a.fit.normal, b.fit.normal) > angle) return std::numeric_limits<double>::infinity();
  const Moments joint = a.moments + b.moments;
  const PlaneFit fit = fit_plane(joint, space);
  const double offset = fit.normal.dot(joint.mean);
  const double base = std::max({a.fit.rms, b.fit.rms, floor});
  const auto loss = [&](const Region& r) {
    return std::sqrt(r.moments.squared_distances(fit.normal, offset) / r.moments.count) / base;
  };
  return std::max(loss(a), loss(b));
}

}  // namespace

Moments sum_of(const VoxelGrid& grid, const std::vector<int>& cells) {
  Moments sum;
  for (const int i : cells) sum += grid.moments[i];
  return sum;
}

std::vector<Moments> sums_of_cubes(const VoxelGrid& grid, const std::vector<int>& cells, int bits) {
  KeyTable cubes;
  std::vector<Moments> sums;
  for (const int i : cells) {
    const VoxelKey& k = grid.keys[i];
    const std::size_t at = cubes.insert({k[0] >> bits, k[1] >> bits, k[2] >> bits});
    if (at == sums.size()) sums.emplace_back();
    sums[at] += grid.moments[i];
  }
  return sums;
}

CellSets merge_regions(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle,
                       CellSets sets, Context& context) {
  std::vector<Region> regions(sets.size());
  std::vector<int> region_of(grid.size(), -1);
  for (std::size_t r = 0; r < sets.size(); ++r) {
    regions[r].moments = sum_of(grid, sets[r]);
    regions[r].fit = fit_plane(regions[r].moments, space);
    for (const int i : sets[r]) region_of[i] = static_cast<int>(r);
    regions[r].cells = std::move(sets[r]);
  }
  for (const auto& [a, b] : adjacent_regions(grid, cells, regions, region_of, context)) {
    regions[a].adjacent.insert(b);
    regions[b].adjacent.insert(a);
  }
  const double floor = 0.02 * 2.0 * grid.edge;
  using Entry = std::tuple<double, int, int>;  // loss, a, b: the best pair first
  std::set<Entry> queue;
  std::map<std::pair<int, int>, double> queued;
  const auto update = [&](int a, int b) {
    const auto key = std::minmax(a, b);
    if (const auto it = queued.find(key); it != queued.end()) {
      queue.erase({it->second, key.first, key.second});
      queued.erase(it);
    }
    const double loss = merge_loss(regions[key.first], regions[key.second], space, angle, floor);
    if (loss > kMergeLoss) return;
    queue.insert({loss, key.first, key.second});
    queued[key] = loss;
  };
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const int o : regions[r].adjacent)
      if (static_cast<int>(r) < o) update(static_cast<int>(r), o);
  while (!queue.empty()) {
    context.check();
    const auto [loss, a, b] = *queue.begin();
    queue.erase(queue.begin());
    queued.erase({a, b});
    Region &ra = regions[a], &rb = regions[b];
    for (const int o : rb.adjacent) {
      if (const auto it = queued.find(std::minmax(b, o)); it != queued.end()) {
        queue.erase({it->second, it->first.first, it->first.second});
        queued.erase(it);
      }
      regions[o].adjacent.erase(b);
      if (o != a) {
        regions[o].adjacent.insert(a);
        ra.adjacent.insert(o);
      }
    }
    ra.cells.insert(ra.cells.end(), rb.cells.begin(), rb.cells.end());
    ra.moments += rb.moments;
    ra.fit = fit_plane(ra.moments, space);
    rb = Region();
    for (const int o : ra.adjacent) update(a, o);
  }
  CellSets result;
  for (Region& r : regions)
    if (!r.cells.empty()) {
      std::sort(r.cells.begin(), r.cells.end());
      result.push_back(std::move(r.cells));
    }
  return result;
}

}  // namespace unseen::planes
