// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <numeric>

#include "planes/result/assign.h"

namespace unseen::planes {

void join_parts(Model& model, const VoxelGrid& grid, const Cells& cells, const Context& context) {
  std::vector<int> part_of(grid.size(), -1), first(model.parts.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    for (const int i : model.parts[p].cells) part_of[i] = static_cast<int>(p);
  const auto first_of = [&](int p) {
    while (first[p] != p) p = first[p] = first[first[p]];
    return p;
  };
  std::vector<int> parts_on(model.surfaces.size(), 0);
  for (const Part& part : model.parts) ++parts_on[part.surface];
  const std::vector<int> part_of_block = grid.labels_of_blocks(part_of);
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    if (parts_on[part.surface] < 2) continue;
    context.check();
    const auto no_other = [&](std::uint32_t block) { return part_of_block[block] == VoxelGrid::kNone || part_of_block[block] == static_cast<int>(p); };
    for (const int i : part.cells)
      grid.for_neighbours_unless(i, voxels_within(cells, grid, i), no_other, [&](int k) {
        if (part_of[k] < 0 || part_of[k] == part_of[i] || model.parts[part_of[k]].surface != part.surface) return;
        if ((grid.moments[k].mean - grid.moments[i].mean).norm() > cells.reach[i]) return;
        const int a = first_of(part_of[i]), b = first_of(part_of[k]);
        first[std::max(a, b)] = std::min(a, b);
      });
  }
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const int to = first_of(static_cast<int>(p));
    if (to == static_cast<int>(p)) continue;
    std::vector<int> &from = model.parts[p].cells, &all = model.parts[to].cells;
    all.insert(all.end(), from.begin(), from.end());
    from.clear();
  }
  std::erase_if(model.parts, [](const Part& part) { return part.cells.empty(); });
  for (Part& part : model.parts) std::sort(part.cells.begin(), part.cells.end());
}

}  // namespace unseen::planes
