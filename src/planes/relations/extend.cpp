// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/result/assign.h"

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
  VoxelSet taken = grid.empty_set(), asleep = grid.empty_set();  // what waits its turn is in neither
  for (std::size_t i = 0; i < grid.size(); ++i) grid.insert(part_of[i] >= 0 ? taken : asleep, i);
  std::vector<int> frontier;
  const auto wake = [&](int from) {
    grid.for_neighbours(from, voxels_within(cells, grid, from), asleep, [&](int i) {
      grid.erase(asleep, i);
      frontier.push_back(i);
    });
  };
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (part_of[i] >= 0) wake(static_cast<int>(i));
  for (int round = 0; round < kRounds && !frontier.empty(); ++round) {
    context.check();
    // All voxels of a round see the same state, so that their order does not matter.
    std::vector<int> joins(frontier.size(), -1);
    parallel_blocks(context, frontier.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const int i = frontier[f];
        double nearest = kOnPlane * cells.tolerance[i];
        int& to = joins[f];
        grid.for_neighbours(i, voxels_within(cells, grid, i), taken, [&](int k) {
          const int p = part_of[k];
          if (p == to) return;
          const double distance = std::abs(planes[p].signed_distance(grid.moments[i].mean));
          if (distance >= nearest || compare_normal(cells, i, planes[p].normal) == NormalVerdict::contradicts) return;
          nearest = distance;
          to = p;
        });
      }
    });
    std::vector<std::pair<int, int>> joined;
    for (std::size_t f = 0; f < frontier.size(); ++f) {
      grid.insert(joins[f] < 0 ? asleep : taken, frontier[f]);
      if (joins[f] >= 0) joined.emplace_back(frontier[f], joins[f]);
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
