// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "planes/scan/voxel_builder.h"
#include "unseen/core/context.h"

namespace unseen::planes {

/// Some of a grid's voxels, as bits of its blocks: where few are left, most blocks are passed over at a glance.
class VoxelSet {
 private:
  friend class VoxelGrid;
  std::vector<std::uint64_t> bits_;
};

/// Occupied voxels in a fixed order (by blocks of 4³), found by key in constant time.
class VoxelGrid {
 public:
  VoxelGrid() = default;
  explicit VoxelGrid(const VoxelBuilder& builder, const Context& context = Context());

  std::size_t size() const { return keys.size(); }
  VoxelKey key_of(const Vec3& p) const;
  Vec3 center_of(const VoxelKey& key) const;
  /// Index of the voxel with this key, or −1 if it is empty.
  int find(const VoxelKey& key) const;
  static constexpr int kFirstReach = 4, kMostReach = 16;
  /// Calls f(index) for each occupied voxel at most `reach` voxels away from `voxel` along every axis, itself
  /// included; blocks nearer to it come first. Up to kFirstReach, or farther where find_farther() was asked for it.
  template <class F>
  void for_neighbours(std::size_t voxel, int reach, F&& f) const;
  /// The same for those in a set, from which f may take the voxel it is called with.
  template <class F>
  void for_neighbours(std::size_t voxel, int reach, const VoxelSet& within, F&& f) const;

  /// The same, passing over the blocks for which skip(block) is true.
  template <class Skip, class F>
  void for_neighbours_unless(std::size_t voxel, int reach, Skip&& skip, F&& f) const;
  static constexpr int kNone = -1, kSeveral = -2;
  /// Of each block the label that its voxels have, apart from those with kNone.
  std::vector<int> labels_of_blocks(const std::vector<int>& label_of_voxel) const;

  /// Lets for_neighbours() look reach[voxel] (≤ kMostReach) voxels away from each voxel.
  void find_farther(const std::vector<int>& reach, const Context& context);

  VoxelSet empty_set() const;
  void insert(VoxelSet& set, std::size_t voxel) const { set.bits_[block_of_[voxel]] |= bit_of(keys[voxel]); }
  void erase(VoxelSet& set, std::size_t voxel) const { set.bits_[block_of_[voxel]] &= ~bit_of(keys[voxel]); }
  bool contains(const VoxelSet& set, std::size_t voxel) const {
    return (set.bits_[block_of_[voxel]] & bit_of(keys[voxel])) != 0;
  }
  /// The same points, without their normals, in voxels of twice the edge; `parent` gets each voxel's index in the coarser grid.
  VoxelGrid coarser(std::vector<int>& parent, const Context& context = Context()) const;

  double edge = 0;
  double tolerance = 0;  ///< m, how far a plane's points may lie from it; twice the edge unless something else is set
  double rounding = 0;   ///< m, the steps that coordinates come in along some axis; 0 = none that matter
  double raster = 0;     ///< m, the same of coordinates that are rounded alike along all axes
  double pixel = 0;      ///< m, the same of a drawing in pixels, beside which there is no noise
  Box within;  ///< what lies outside is in no voxel
  LargeVector<VoxelKey> keys;
  LargeVector<Moments> moments;
  LargeVector<Eigen::Matrix3f> normals;  ///< Σ m mᵀ of input normals; empty if the input has none

 private:
  static constexpr int kRings = kMostReach / 4;  ///< how many blocks away neighbours are linked, at most
  static int rings_within(int reach) { return std::min((reach + 3) / 4, kRings); }
  /// [reach][axis][place in its block]: of the block that lies 0…2·kRings blocks behind the first linked one along
  /// an axis, the voxels that are within reach of one at that place, as bits of its mask.
  using Slices = std::array<std::array<std::array<std::array<std::uint64_t, 2 * kRings + 1>, 4>, 3>, kMostReach + 1>;
  static const Slices kSlices;
  struct Block {
    std::uint64_t mask = 0;   ///< which of its 4³ voxels are occupied, x slowest
    std::uint32_t first = 0;  ///< index of its first voxel
    std::int32_t rings = 0;   ///< so far it is linked
    std::array<std::uint32_t, kRings + 2> ring{};  ///< [ring[r]…ring[r+1]) of its run's links: occupied blocks r blocks away
  };
  /// Lays out the voxels with these keys (some may be equal) and returns the index of each.
  std::vector<int> place(const LargeVector<VoxelKey>& unordered, const Context& context);
  void link_blocks(const std::vector<int>& rings_of_block, const Context& context);
  /// A voxel's place in the mask of its block.
  static std::uint64_t bit_of(const VoxelKey& k) {
    return std::uint64_t{1} << (((k[0] & 3) << 4) | ((k[1] & 3) << 2) | (k[2] & 3));
  }
  template <class Bits, class F>
  void visit_blocks(std::size_t voxel, int reach, Bits&& bits, F&& f) const;

  KeyTable block_table_;
  LargeVector<Block> blocks_;              ///< parallel to block_table_.keys()
  static constexpr std::size_t kRun = 4096;         ///< blocks that are linked together
  std::vector<LargeVector<std::uint32_t>> linked_;  ///< of each run, indices of blocks
  LargeVector<std::uint32_t> block_of_;    ///< of each voxel
};

/// Bits set; without the instruction, which the oldest 64-bit machines lack.
inline int count_bits(std::uint64_t x) {
  x -= (x >> 1) & 0x5555555555555555u;
  x = (x & 0x3333333333333333u) + ((x >> 2) & 0x3333333333333333u);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<int>((x * 0x0101010101010101u) >> 56);
}

template <class Bits, class F>
void VoxelGrid::visit_blocks(std::size_t voxel, int reach, Bits&& bits, F&& f) const {
  const VoxelKey& key = keys[voxel];
  const auto& slices = kSlices[std::min(reach, kMostReach)];
  const auto &x = slices[0][key[0] & 3], &y = slices[1][key[1] & 3], &z = slices[2][key[2] & 3];
  const VoxelKey* const block_key = block_table_.keys().data();
  const VoxelKey home_key = block_key[block_of_[voxel]];
  const Block& home = blocks_[block_of_[voxel]];
  assert(rings_within(reach) <= home.rings);
  const std::uint32_t* const links = linked_[block_of_[voxel] / kRun].data();
  const std::uint32_t end = home.ring[rings_within(reach) + 1];
  for (std::uint32_t l = home.ring[0]; l < end; ++l) {
    const std::uint32_t b = links[l];
    const VoxelKey& k = block_key[b];
    std::uint64_t found = bits(b) & x[k[0] - home_key[0] + kRings] & y[k[1] - home_key[1] + kRings] & z[k[2] - home_key[2] + kRings];
    for (; found != 0; found &= found - 1)
      f(static_cast<int>(blocks_[b].first + count_bits(blocks_[b].mask & ((found & -found) - 1))));
  }
}

template <class F>
void VoxelGrid::for_neighbours(std::size_t voxel, int reach, F&& f) const {
  visit_blocks(voxel, reach, [&](std::uint32_t b) { return blocks_[b].mask; }, f);
}

template <class F>
void VoxelGrid::for_neighbours(std::size_t voxel, int reach, const VoxelSet& within, F&& f) const {
  visit_blocks(voxel, reach, [&](std::uint32_t b) { return within.bits_[b]; }, f);
}

template <class Skip, class F>
void VoxelGrid::for_neighbours_unless(std::size_t voxel, int reach, Skip&& skip, F&& f) const {
  visit_blocks(voxel, reach, [&](std::uint32_t b) { return skip(b) ? 0 : blocks_[b].mask; }, f);
}

}  // namespace unseen::planes
