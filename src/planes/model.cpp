// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include "planes/reconcile.h"

namespace unseen::planes {
namespace {

/// Patches of one orientation that adjoin within the scale, as groups; each is named by its largest patch.
std::vector<int> join_coplanar(const Patches& patches, const std::vector<Vec3>& normals, const Cells& cells) {
  const std::size_t n = patches.patches.size();
  std::vector<int> group(n);
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int j) {
    while (group[j] != j) j = group[j] = group[group[j]];
    return j;
  };
  std::vector<Moments> sums(n);
  for (std::size_t j = 0; j < n; ++j) sums[j] = patches.patches[j].moments;
  const auto gap = [&](int a, int b) { return std::abs(normals[a].dot(sums[a].mean - sums[b].mean)); };
  struct Join {
    double gap;
    int a, b;
  };
  std::vector<Join> joins;
  for (const auto& [a, b] : patches.adjoining)
    if (line_angle(normals[a], normals[b]) < 1e-7) joins.push_back({gap(a, b), a, b});
  std::stable_sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.gap < b.gap; });
  const auto tolerance = [&](int j) { return cells.tolerance[patches.patches[j].cells.front()]; };
  for (const Join& join : joins) {
    const int a = root(join.a), b = root(join.b);
    if (a == b || gap(a, b) >= std::min(tolerance(join.a), tolerance(join.b))) continue;
    group[std::max(a, b)] = std::min(a, b);
    sums[std::min(a, b)] += sums[std::max(a, b)];
  }
  for (std::size_t j = 0; j < n; ++j) group[j] = root(static_cast<int>(j));
  return group;
}

}  // namespace

Model build_model(const Selection& selection, const Patches& patches, const VoxelGrid& grid, const Cells& cells,
                  const AngleSet& angles, const Space& space, Context& context) {
  Model model;
  model.locals = local_directions(angles, space);
  Reconciled r = reconcile(selection, patches, model.locals, angles, space);
  context.check();
  model.frames = std::move(r.frames);
  model.constraints = std::move(r.constraints);

  std::vector<Vec3> normals;
  for (std::size_t j = 0; j < patches.patches.size(); ++j)
    normals.push_back(model.frames[r.frame_of_patch[j]].direction(model.locals[r.local_of_patch[j]]));
  const std::vector<int> group = join_coplanar(patches, normals, cells);
  std::vector<std::vector<int>> cells_of(patches.patches.size());
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const std::vector<int>& c = patches.patches[j].cells;
    cells_of[group[j]].insert(cells_of[group[j]].end(), c.begin(), c.end());
  }
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    if (cells_of[j].empty()) continue;
    std::sort(cells_of[j].begin(), cells_of[j].end());
    PlaneModel plane;
    plane.frame = r.frame_of_patch[j];
    plane.local = r.local_of_patch[j];
    plane.support = make_patch(grid, space, std::move(cells_of[j]));
    model.planes.push_back(std::move(plane));
  }
  return model;
}

}  // namespace unseen::planes
