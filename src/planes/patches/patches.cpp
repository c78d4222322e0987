// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kBesideReach = 1.6, kBesideInDrawings = 2.5;  // of the reach: where patches adjoin; lines end before the corner, whose cells have no normal

/// Half the median rms of regions, and no less than rounding leaves.
double least_noise_of(const VoxelGrid& grid, const Space& space, const CellSets& regions) {
  if (regions.empty()) return 0.0;
  std::vector<double> rms;
  for (const std::vector<int>& region : regions) rms.push_back(fit_plane(sum_of(grid, region), space).rms);
  return std::max(0.5 * median(std::move(rms)), grid.raster / std::sqrt(12.0));
}

using Pairs = std::vector<std::pair<int, int>>;

void sort_unique(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

void find_neighbours(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle, Patches& result, const Context& context) {
  const double beside_within = space.is_2d() ? kBesideInDrawings : kBesideReach;
  const std::vector<int>& patch_of_cell = result.patch_of_cell;
  std::vector<int> parent;
  VoxelGrid coarse = grid.coarser(parent, context);  // voxels of edge ρ
  struct Member {  // a patch's share of a voxel
    int patch;
    Eigen::AlignedBox3d box;
    Vec3 normal;
    double reach;  // m
  };
  LargeVector<std::vector<Member>> members(coarse.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int patch = patch_of_cell[i];
    if (patch < 0) continue;
    auto& list = members[parent[i]];
    auto it = std::find_if(list.begin(), list.end(), [&](const Member& m) { return m.patch == patch; });
    if (it == list.end()) it = list.insert(it, {patch, {}, cells.normal[i], 0.0});
    it->box.extend(grid.moments[i].mean);
    it->reach = std::max(it->reach, beside_within * cells.reach[i]);
  }
  const auto voxels_within = [&](const Member& m) { return static_cast<int>(m.reach / coarse.edge); };
  std::vector<int> reach(coarse.size(), 0);
  for (std::size_t c = 0; c < coarse.size(); ++c)
    for (const Member& m : members[c]) reach[c] = std::max(reach[c], voxels_within(m));
  coarse.find_farther(reach, context);
  const double cos_angle = std::cos(angle);
  std::mutex joining;
  parallel_blocks(context, coarse.size(), 512, [&](std::size_t begin, std::size_t end) {
    Pairs adjoining, neighbours;
    std::vector<int> beside, alike;  // patches found around one member
    const auto once = [](std::vector<int>& list, int patch) {
      if (std::find(list.begin(), list.end(), patch) == list.end()) list.push_back(patch);
    };
    for (std::size_t c = begin; c < end; ++c)
      for (const Member& a : members[c]) {
        beside.clear();
        alike.clear();
        coarse.for_neighbours(c, voxels_within(a), [&](int o) {
          for (const Member& b : members[o]) {
            if (a.patch == b.patch || a.box.squaredExteriorDistance(b.box) >= a.reach * a.reach) continue;
            once(beside, b.patch);
            if (std::abs(a.normal.dot(b.normal)) > cos_angle) once(alike, b.patch);
          }
        });
        for (const int b : beside) adjoining.push_back(std::minmax(a.patch, b));
        for (const int b : alike) neighbours.push_back(std::minmax(a.patch, b));
      }
    sort_unique(adjoining);
    sort_unique(neighbours);
    const std::lock_guard lock(joining);  // in any order: the whole is sorted
    result.adjoining.insert(result.adjoining.end(), adjoining.begin(), adjoining.end());
    result.neighbours.insert(result.neighbours.end(), neighbours.begin(), neighbours.end());
  });
  sort_unique(result.adjoining);
  sort_unique(result.neighbours);
}

}  // namespace

Patches segment(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle, Context& context) {
  CellSets regions = grow_regions(grid, cells, space, angle, context);
  const CellSets uncut = split_regions(grid, space, std::move(regions), context);
  regions = merge_regions(grid, cells, space, angle, uncut, context);
  regions = split_regions(grid, space, std::move(regions), context, uncut);
  regions = drop_rims(grid, cells, space, std::move(regions), context);
  regions = drop_strays(grid, space, std::move(regions), context);

  Patches result;
  result.least_noise = least_noise_of(grid, space, regions);
  result.patches.resize(regions.size());
  parallel_blocks(context, regions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      result.patches[r] = make_patch(grid, space, std::move(regions[r]), result.least_noise, cells);
  });
  std::stable_sort(result.patches.begin(), result.patches.end(),
                   [](const Patch& a, const Patch& b) { return a.area > b.area; });
  result.patch_of_cell.assign(grid.size(), -1);
  for (std::size_t j = 0; j < result.patches.size(); ++j)
    for (const int i : result.patches[j].cells) result.patch_of_cell[i] = static_cast<int>(j);
  find_neighbours(grid, cells, space, angle, result, context);
  if (space.is_2d()) return result;
  mark_bowed(grid, context, result);
  result.waves = measure_waves(grid, result, context);
  for (Patch& patch : result.patches) add_waves(result.waves, patch);
  return result;
}

}  // namespace unseen::planes
