// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
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
    std::uint64_t mask = 0;  ///< which of its 64 voxels are occupied
    std::uint32_t first = 0;  ///< index of its first voxel
  };
  struct KeyHash {
    std::size_t operator()(const VoxelKey& k) const;
  };
  void index_blocks();
  std::unordered_map<VoxelKey, Block, KeyHash> blocks_;
};

/// Reads the source once and sums its points into voxels of the given edge (m).
VoxelBuilder summarise(PointSource& source, double edge, const std::vector<bool>& duplicate, Context& context);

template <class F>
void VoxelGrid::for_neighbours(const VoxelKey& key, int reach, F&& f) const {
  const auto floor4 = [](std::int32_t v) { return v >> 2; };
  const VoxelKey low = {key[0] - reach, key[1] - reach, key[2] - reach};
  const VoxelKey high = {key[0] + reach, key[1] + reach, key[2] + reach};
  for (int bx = floor4(low[0]); bx <= floor4(high[0]); ++bx)
    for (int by = floor4(low[1]); by <= floor4(high[1]); ++by)
      for (int bz = floor4(low[2]); bz <= floor4(high[2]); ++bz) {
        const auto it = blocks_.find({bx, by, bz});
        if (it == blocks_.end()) continue;
        const Block& block = it->second;
        for (int x = std::max(low[0], 4 * bx); x <= std::min(high[0], 4 * bx + 3); ++x)
          for (int y = std::max(low[1], 4 * by); y <= std::min(high[1], 4 * by + 3); ++y)
            for (int z = std::max(low[2], 4 * bz); z <= std::min(high[2], 4 * bz + 3); ++z) {
              const int bit = ((x & 3) << 4) | ((y & 3) << 2) | (z & 3);
              if (block.mask >> bit & 1)
                f(static_cast<int>(block.first +
                                   __builtin_popcountll(block.mask & ((std::uint64_t{1} << bit) - 1))));
            }
      }
}

}  // namespace unseen::planes
