// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/large_pages.h"
#include "planes/scan/moments.h"
#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"

namespace unseen::planes {

/// What is near enough to be looked at; by default all that is finite. Not a number is in no box.
struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::lowest());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::max());
  bool contains(const Vec3& p) const { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); }
};

using VoxelKey = std::array<std::int32_t, 3>;

/// Sums over the points of one voxel, in integers (positions relative to the voxel in steps of 2⁻¹⁸ of its
/// edge), so that they do not depend on the order of the points nor on how a cloud was cut into tiles.
struct VoxelSums {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> first{};   ///< Σ q
  std::array<std::int64_t, 6> second{};  ///< Σ q qᵀ: xx, xy, xz, yy, yz, zz
  std::array<std::int64_t, 6> normal{};  ///< Σ m mᵀ of unit normals m in steps of 2⁻¹⁴, where given
  VoxelSums& operator+=(const VoxelSums& o);
  bool has_normals() const { return normal[0] + normal[3] + normal[5] > 0; }
};

/// The same in metres, of a voxel of this edge: count, mean and scatter of its points.
Moments moments_of(const VoxelSums& sums, const VoxelKey& key, double edge);
/// Σ n nᵀ of its unit normals.
Mat3 normals_of(const VoxelSums& sums);

/// A growing list of distinct keys, found again in constant time (open addressing).
class KeyTable {
 public:
  const LargeVector<VoxelKey>& keys() const { return keys_; }
  /// Index of a key, or −1.
  int find(const VoxelKey& key) const;
  /// Index of a key, which is appended if it is new.
  std::size_t insert(const VoxelKey& key);
  void reserve(std::size_t keys) { keys_.reserve(keys); }

 private:
  std::size_t slot(const VoxelKey& key) const;
  void grow();

  LargeVector<VoxelKey> keys_;
  LargeVector<std::uint32_t> slots_;  ///< index + 1 into keys_, 0 = free; at most half are taken
};

/// Gathers the points of a box into voxels. Filled tile by tile; two builders of one grid can be joined exactly.
class VoxelBuilder {
 public:
  explicit VoxelBuilder(double edge, const Box& within = {}) : edge_(edge), within_(within) {}

  /// Adds every point of a block that is in the box, except those for which skip[first + i] is set (empty =
  /// none).
  /// Throws InputError if a coordinate is too large for the grid (2³¹ voxels).
  void add(const PointCloud& block, const std::vector<bool>& skip = {}, std::size_t first = 0);
  void join(const VoxelBuilder& other);
  /// Makes room for so many voxels at once: what is not filled costs nothing, but growing step by step does.
  void reserve(std::size_t voxels);

  double edge() const { return edge_; }
  const Box& within() const { return within_; }
  std::size_t outside() const { return outside_; }  ///< finite points that are not in the box
  const LargeVector<VoxelKey>& keys() const { return table_.keys(); }
  const LargeVector<VoxelSums>& sums() const { return sums_; }

 private:
  VoxelSums& sums_of(const VoxelKey& key);

  double edge_;
  Box within_;
  std::size_t outside_ = 0;
  KeyTable table_;
  LargeVector<VoxelSums> sums_;
};

/// Reads the source once and sums its points within a box into voxels of the given edge (m).
VoxelBuilder summarise(PointSource& source, double edge, const Box& within, const std::vector<bool>& duplicate,
                       Context& context);

}  // namespace unseen::planes
