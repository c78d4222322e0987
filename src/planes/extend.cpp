// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/assign.h"

namespace unseen::planes {
namespace {

constexpr int kRounds = 20;       // a part grows by at most this many times the local reach
constexpr double kOnPlane = 0.5;  // of the scale

}  // namespace

void extend_parts(Model& model, const VoxelGrid& grid, const Cells& cells, const Context& context) {
  std::vector<int> part_of(grid.size(), -1);
  std::vector<Plane> planes;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    planes.push_back(model.plane(model.parts[p]));
    for (const int i : model.parts[p].cells) part_of[i] = static_cast<int>(p);
  }
  std::vector<char> waiting(grid.size(), 0);
  std::vector<int> frontier;
  const auto wake = [&](int from) {
    grid.for_neighbours(from, voxels_within(cells, grid, from), [&](int i) {
      if (part_of[i] >= 0 || waiting[i]) return;
      waiting[i] = 1;
      frontier.push_back(i);
    });
  };
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (part_of[i] >= 0) wake(static_cast<int>(i));
  for (int round = 0; round < kRounds && !frontier.empty(); ++round) {
    context.check();
    // All voxels of a round see the same state, so that their order does not matter.
    std::vector<std::pair<int, int>> joined;
    for (const int i : frontier) {
      waiting[i] = 0;
      double nearest = kOnPlane * cells.tolerance[i];
      int to = -1;
      grid.for_neighbours(i, voxels_within(cells, grid, i), [&](int k) {
        const int p = part_of[k];
        if (p < 0 || p == to) return;
        const double distance = std::abs(planes[p].signed_distance(grid.moments[i].mean));
        if (distance >= nearest || compare_normal(cells, i, planes[p].normal) == NormalVerdict::contradicts) return;
        nearest = distance;
        to = p;
      });
      if (to >= 0) joined.emplace_back(i, to);
    }
    frontier.clear();
    for (const auto& [i, p] : joined) {
      part_of[i] = p;
      model.parts[p].cells.push_back(i);
    }
    for (const auto& [i, p] : joined) wake(i);
    std::sort(frontier.begin(), frontier.end());
  }
  for (Part& part : model.parts) std::sort(part.cells.begin(), part.cells.end());
}

}  // namespace unseen::planes
