// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "planes/scan/voxels.h"

namespace unseen::planes {
namespace {

/// A column's x and y as one number that sorts alike.
std::uint64_t column_of(std::int32_t x, std::int32_t y) {
  constexpr std::uint32_t kSign = 0x80000000u;
  return std::uint64_t{static_cast<std::uint32_t>(x) ^ kSign} << 32 | (static_cast<std::uint32_t>(y) ^ kSign);
}

/// Blocks in the order of their keys, and where each column of them begins; the last begins where the blocks end.
struct Columns {
  std::vector<std::uint64_t> at;
  std::vector<std::uint32_t> first;
  std::vector<std::int32_t> z;  ///< of each block
};

Columns columns_of(const LargeVector<VoxelKey>& blocks) {
  Columns columns;
  columns.z.reserve(blocks.size());
  for (const VoxelKey& k : blocks) {
    const std::uint64_t at = column_of(k[0], k[1]);
    if (columns.at.empty() || columns.at.back() != at) {
      columns.at.push_back(at);
      columns.first.push_back(static_cast<std::uint32_t>(columns.z.size()));
    }
    columns.z.push_back(k[2]);
  }
  columns.at.push_back(std::numeric_limits<std::uint64_t>::max());
  columns.first.push_back(static_cast<std::uint32_t>(columns.z.size()));
  return columns;
}

/// The first block of a column at z or above.
std::uint32_t first_at(const Columns& columns, std::size_t column, std::int32_t z) {
  constexpr std::uint32_t kFew = 16;
  std::uint32_t first = columns.first[column];
  const std::uint32_t end = columns.first[column + 1];
  if (end - first > kFew)
    return static_cast<std::uint32_t>(std::lower_bound(columns.z.begin() + first, columns.z.begin() + end, z) - columns.z.begin());
  while (first < end && columns.z[first] < z) ++first;
  return first;
}

}  // namespace

/// Blocks are sorted, so that in each row of columns beside one the first that it may ask for moves only forward with it.
void VoxelGrid::link_blocks(const std::vector<int>& rings_of_block, const Context& context) {
  const LargeVector<VoxelKey>& key = block_table_.keys();
  if (key.empty()) return;
  const Columns columns = columns_of(key);
  const int most = *std::max_element(rings_of_block.begin(), rings_of_block.end());
  linked_.resize((key.size() + kRun - 1) / kRun);
  parallel_blocks(context, linked_.size(), 1, [&](std::size_t run, std::size_t run_end) {
    std::array<std::vector<std::uint32_t>, kRings + 1> found;
    LargeVector<std::uint32_t> links;
    std::array<std::size_t, 2 * kRings + 1> row;  // its first column at y − most or beyond
    for (; run < run_end; ++run) {
      links.clear();
      const VoxelKey& start = key[run * kRun];
      for (int dx = -most; dx <= most; ++dx)
        row[dx + most] = std::lower_bound(columns.at.begin(), columns.at.end(), column_of(start[0] + dx, start[1] - most)) - columns.at.begin();
      for (std::size_t b = run * kRun; b < std::min(key.size(), (run + 1) * kRun); ++b) {
        const auto [x, y, z] = key[b];
        const int rings = blocks_[b].rings = rings_of_block[b];
        for (auto& ring : found) ring.clear();
        for (int dx = -rings; dx <= rings; ++dx) {
          std::size_t& first = row[dx + most];
          while (columns.at[first] < column_of(x + dx, y - most)) ++first;
          for (std::size_t c = first; columns.at[c] <= column_of(x + dx, y + rings); ++c) {
            if (columns.at[c] < column_of(x + dx, y - rings)) continue;
            const int dy = static_cast<int>(static_cast<std::int64_t>(columns.at[c] - column_of(x + dx, y)));
            for (std::uint32_t o = first_at(columns, c, z - rings); o < columns.first[c + 1] && columns.z[o] <= z + rings; ++o)
              found[std::max({std::abs(dx), std::abs(dy), std::abs(columns.z[o] - z)})].push_back(o);
          }
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
