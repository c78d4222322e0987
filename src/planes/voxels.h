// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <unordered_map>
#include <vector>

#include "planes/moments.h"
#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"

namespace unseen::planes {

using VoxelKey = std::array<std::int32_t, 3>;

/// Sums over the points of one voxel, in integers (positions relative to the voxel in steps of 2⁻¹⁸ of its
/// edge), so that they do not depend on the order of the points nor on how a cloud was cut into tiles.
struct VoxelSums {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> first{};   ///< Σ q
  std::array<std::int64_t, 6> second{};  ///< Σ q qᵀ: xx, xy, xz, yy, yz, zz
  std::array<std::int64_t, 6> normal{};  ///< Σ m mᵀ of unit normals m in steps of 2⁻¹⁴, where given
  VoxelSums& operator+=(const VoxelSums& o);
};

/// Gathers points into voxels. Filled tile by tile; two builders of one grid can be joined exactly.
class VoxelBuilder {
 public:
  explicit VoxelBuilder(double edge) : edge_(edge) {}

  /// Adds every finite point of a block, except those for which skip[i] is set (empty = none).
  /// Throws InputError if a coordinate is too large for the grid (2³¹ voxels).
  void add(const PointCloud& block, const std::vector<bool>& skip = {});
  void join(const VoxelBuilder& other);

  double edge() const { return edge_; }
  const std::vector<VoxelKey>& keys() const { return keys_; }
  const std::vector<VoxelSums>& sums() const { return sums_; }

 private:
  std::size_t slot(const VoxelKey& key);
  void grow();

  double edge_;
  std::vector<VoxelKey> keys_;
  std::vector<VoxelSums> sums_;
  std::vector<std::uint32_t> table_;  ///< open addressing: index + 1 into keys_, 0 = free
};

/// Occupied voxels in a fixed order (by blocks of 4³), found by key in constant time.
class VoxelGrid {
 public:
  VoxelGrid() = default;
  explicit VoxelGrid(const VoxelBuilder& builder);

  std::size_t size() const { return keys.size(); }
  VoxelKey key_of(const Vec3& p) const;
  Vec3 center_of(const VoxelKey& key) const;
  /// Index of the voxel with this key, or −1 if it is empty.
  int find(const VoxelKey& key) const;
  /// Calls f(index) for each occupied voxel at most `reach` voxels away along every axis, itself included,
  /// in the order of the grid's blocks.
  template <class F>
  void for_neighbours(const VoxelKey& key, int reach, F&& f) const;
  /// The same points in voxels of twice the edge; `parent` gets each voxel's index in the coarser grid.
  VoxelGrid coarser(std::vector<int>& parent) const;

  double edge = 0;
  std::vector<VoxelKey> keys;
  std::vector<Moments> moments;
  std::vector<Mat3> normals;  ///< Σ m mᵀ of input normals; empty if the input has none

 private:
  struct Block {
    VoxelKey key;             ///< voxel keys / 4, rounded down
    std::uint64_t mask = 0;   ///< which of its 4³ voxels are occupied, x slowest
    std::uint32_t first = 0;  ///< index of its first voxel
    std::array<std::int32_t, 27> around;  ///< the blocks beside it, −1 where there is none; itself in the middle
  };
  struct KeyHash {
    std::size_t operator()(const VoxelKey& k) const;
  };
  void index_blocks();
  int block_at(const VoxelKey& block_key) const;
  template <class F>
  static void visit(const Block& block, const VoxelKey& low, const VoxelKey& high, F&& f);

  std::vector<Block> blocks_;
  std::unordered_map<VoxelKey, std::int32_t, KeyHash> block_of_key_;
};

/// Reads the source once and sums its points into voxels of the given edge (m).
VoxelBuilder summarise(PointSource& source, double edge, const std::vector<bool>& duplicate, Context& context);

template <class F>
void VoxelGrid::visit(const Block& block, const VoxelKey& low, const VoxelKey& high, F&& f) {
  // The part of the 4³ bits that lies in the box, axis by axis.
  const auto range = [&](int a) {
    return std::pair{std::max(low[a] - 4 * block.key[a], 0), std::min(high[a] - 4 * block.key[a], 3)};
  };
  const auto ones = [](int count) { return (std::uint64_t{1} << count) - 1; };  // count < 64
  const auto [x0, x1] = range(0);
  const auto [y0, y1] = range(1);
  const auto [z0, z1] = range(2);
  const std::uint64_t row = (ones(z1 - z0 + 1) << z0) * 0x1111u;                      // z, in four rows
  const std::uint64_t slab = row & (ones(4 * (y1 - y0 + 1)) << (4 * y0)) & 0xffffu;    // y
  const std::uint64_t cube = slab * 0x0001000100010001u;                              // in four slabs
  const std::uint64_t in_x = x1 - x0 == 3 ? ~std::uint64_t{0} : ones(16 * (x1 - x0 + 1)) << (16 * x0);
  for (std::uint64_t bits = block.mask & cube & in_x; bits != 0; bits &= bits - 1) {
    const std::uint64_t below = (bits & -bits) - 1;
    f(static_cast<int>(block.first + __builtin_popcountll(block.mask & below)));
  }
}

template <class F>
void VoxelGrid::for_neighbours(const VoxelKey& key, int reach, F&& f) const {
  const VoxelKey low = {key[0] - reach, key[1] - reach, key[2] - reach};
  const VoxelKey high = {key[0] + reach, key[1] + reach, key[2] + reach};
  const VoxelKey home = {key[0] >> 2, key[1] >> 2, key[2] >> 2};
  const int center = block_at(home);
  for (int x = low[0] >> 2; x <= high[0] >> 2; ++x)
    for (int y = low[1] >> 2; y <= high[1] >> 2; ++y)
      for (int z = low[2] >> 2; z <= high[2] >> 2; ++z) {
        const int dx = x - home[0], dy = y - home[1], dz = z - home[2];
        const bool beside = center >= 0 && std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) <= 1;
        const int block = beside ? blocks_[center].around[9 * (dx + 1) + 3 * (dy + 1) + dz + 1] : block_at({x, y, z});
        if (block >= 0) visit(blocks_[block], low, high, f);
      }
}

}  // namespace unseen::planes
