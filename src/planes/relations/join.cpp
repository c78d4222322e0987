// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <numeric>

#include "planes/result/assign.h"

namespace unseen::planes {
namespace {

constexpr double kFarOff = 4.0;             // times the widest reach of a part: what is nearer is one piece, what is four times as far is not
constexpr double kPieceOfPart = 0.05;       // of its points: a plane of its own
constexpr std::size_t kFewestOfPiece = 20;  // voxels

/// A part's cells in pieces that lie far from each other; what is too small for one goes with the largest, which comes first.
std::vector<std::vector<int>> pieces_of(const Part& part, const VoxelGrid& grid, const Cells& cells) {
  double edge = 0;
  for (const int i : part.cells) edge = std::max(edge, kFarOff * cells.reach[i]);
  KeyTable blocks;
  std::vector<std::size_t> block_of;
  for (const int i : part.cells) {
    const Vec3 at = (grid.moments[i].mean / edge).array().floor();
    block_of.push_back(blocks.insert({static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()), static_cast<std::int32_t>(at.z())}));
  }
  const std::size_t count = blocks.keys().size();
  std::vector<int> piece_of(count, -1);
  int pieces = 0;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (piece_of[seed] >= 0) continue;
    std::vector<std::size_t> open = {seed};
    piece_of[seed] = pieces;
    while (!open.empty()) {
      const VoxelKey from = blocks.keys()[open.back()];
      open.pop_back();
      for (int n = 0; n < 27; ++n) {
        const int next = blocks.find({from[0] + n % 3 - 1, from[1] + n / 3 % 3 - 1, from[2] + n / 9 - 1});
        if (next < 0 || piece_of[next] >= 0) continue;
        piece_of[next] = pieces;
        open.push_back(static_cast<std::size_t>(next));
      }
    }
    ++pieces;
  }
  if (pieces == 1) return {part.cells};
  std::vector<std::vector<int>> found(pieces);
  std::vector<double> points(pieces, 0.0);
  double all = 0;
  for (std::size_t k = 0; k < part.cells.size(); ++k) {
    const int piece = piece_of[block_of[k]];
    found[piece].push_back(part.cells[k]);
    points[piece] += grid.moments[part.cells[k]].count;
    all += grid.moments[part.cells[k]].count;
  }
  std::vector<int> order(pieces);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return points[a] > points[b]; });
  std::vector<std::vector<int>> kept;
  for (const int piece : order) {
    if (kept.empty() || (points[piece] >= kPieceOfPart * all && found[piece].size() >= kFewestOfPiece)) kept.push_back(std::move(found[piece]));
    else kept.front().insert(kept.front().end(), found[piece].begin(), found[piece].end());
  }
  std::sort(kept.front().begin(), kept.front().end());
  return kept;
}

}  // namespace

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
  const std::size_t joined = model.parts.size();
  for (std::size_t p = 0; p < joined; ++p) {
    std::sort(model.parts[p].cells.begin(), model.parts[p].cells.end());
    std::vector<std::vector<int>> pieces = pieces_of(model.parts[p], grid, cells);
    for (std::size_t k = 1; k < pieces.size(); ++k) model.parts.push_back({model.parts[p].surface, std::move(pieces[k])});
    model.parts[p].cells = std::move(pieces.front());
  }
}

}  // namespace unseen::planes
