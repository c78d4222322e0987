// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "planes/voxels.h"

namespace unseen::planes {
namespace {

/// Blocks in the order of their keys; x and y as one number that sorts alike.
struct SortedBlocks {
  std::vector<std::uint64_t> column;
  std::vector<std::int32_t> z;
};

std::uint64_t column_of(std::int32_t x, std::int32_t y) {
  constexpr std::uint32_t kSign = 0x80000000u;
  return std::uint64_t{static_cast<std::uint32_t>(x) ^ kSign} << 32 | (static_cast<std::uint32_t>(y) ^ kSign);
}

constexpr std::size_t kUnknown = -1;

/// The first block of a column at z or above.
std::size_t first_at(const SortedBlocks& blocks, std::uint64_t column, std::int32_t z) {
  const auto [from, to] = std::equal_range(blocks.column.begin(), blocks.column.end(), column);
  const auto first = blocks.z.begin() + (from - blocks.column.begin()), last = first + (to - from);
  return static_cast<std::size_t>(std::lower_bound(first, last, z) - blocks.z.begin());
}

}  // namespace

/// Blocks are sorted, so that the first block of each column beside one, as low as any may ask for, moves only forward with it.
void VoxelGrid::link_blocks(const std::vector<int>& rings_of_block, const Context& context) {
  const LargeVector<VoxelKey>& key = block_table_.keys();
  if (key.empty()) return;
  SortedBlocks sorted;
  for (const VoxelKey& k : key) {
    sorted.column.push_back(column_of(k[0], k[1]));
    sorted.z.push_back(k[2]);
  }
  const int most = *std::max_element(rings_of_block.begin(), rings_of_block.end()), side = 2 * most + 1;
  linked_.resize((key.size() + kRun - 1) / kRun);
  parallel_blocks(context, linked_.size(), 1, [&](std::size_t run, std::size_t run_end) {
    std::array<std::vector<std::uint32_t>, kRings + 1> found;
    LargeVector<std::uint32_t> links;
    std::vector<std::size_t> first(side * side);
    for (; run < run_end; ++run) {
      links.clear();
      std::fill(first.begin(), first.end(), kUnknown);
      for (std::size_t b = run * kRun; b < std::min(key.size(), (run + 1) * kRun); ++b) {
        const auto [x, y, z] = key[b];
        const int rings = blocks_[b].rings = rings_of_block[b];
        for (auto& ring : found) ring.clear();
        for (int dx = -rings; dx <= rings; ++dx)
          for (int dy = -rings; dy <= rings; ++dy) {
            const std::uint64_t column = column_of(x + dx, y + dy);
            std::size_t& at = first[(dx + most) * side + dy + most];
            if (at == kUnknown) at = first_at(sorted, column, z - most);
            while (at < key.size() && (sorted.column[at] < column || (sorted.column[at] == column && sorted.z[at] < z - most))) ++at;
            for (std::size_t o = at; o < key.size() && sorted.column[o] == column && sorted.z[o] <= z + rings; ++o)
              if (sorted.z[o] >= z - rings) found[std::max({std::abs(dx), std::abs(dy), std::abs(sorted.z[o] - z)})].push_back(static_cast<std::uint32_t>(o));
          }
        for (int r = 0; r <= kRings; ++r) {
          blocks_[b].ring[r] = static_cast<std::uint32_t>(links.size());
          links.insert(links.end(), found[r].begin(), found[r].end());
        }
        blocks_[b].ring[kRings + 1] = static_cast<std::uint32_t>(links.size());
      }
      linked_[run] = links;  // copied, as it has just the room it needs
    }
  });
}

}  // namespace unseen::planes
