// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/voxels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unseen::planes {
namespace {

VoxelKey block_key_of(const VoxelKey& k) { return {k[0] >> 2, k[1] >> 2, k[2] >> 2}; }

}  // namespace

constinit const VoxelGrid::Slices VoxelGrid::kSlices = [] {
  constexpr std::uint64_t kFirst[] = {0xffff, 0x000f'000f'000f'000f, 0x1111'1111'1111'1111};  // of the four slices across an axis
  constexpr int kApart[] = {16, 4, 1};                                                       // bits from one to the next
  Slices slices{};
  for (int reach = 0; reach <= kMostReach; ++reach)
    for (int axis = 0; axis < 3; ++axis)
      for (int at = 0; at < 4; ++at)
        for (int slice = 0; slice < 4 * (2 * kRings + 1); ++slice)
          if (const int apart = slice - 4 * kRings - at; -reach <= apart && apart <= reach)
            slices[reach][axis][at][slice / 4] |= kFirst[axis] << kApart[axis] * (slice % 4);
  return slices;
}();

VoxelGrid::VoxelGrid(const VoxelBuilder& builder, const Context& context)
    : edge(builder.edge()), tolerance(2.0 * builder.edge()), within(builder.within()) {
  const std::vector<int> place_of = place(builder.keys(), context);
  moments.resize(size());
  const bool any_normals = std::any_of(builder.sums().begin(), builder.sums().end(), [](const VoxelSums& s) { return s.has_normals(); });
  if (any_normals) normals.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const VoxelSums& sums = builder.sums()[i];
    moments[place_of[i]] = moments_of(sums, builder.keys()[i], edge);
    if (any_normals) normals[place_of[i]] = normals_of(sums).cast<float>();
  }
}

std::vector<int> VoxelGrid::place(const LargeVector<VoxelKey>& unordered, const Context& context) {
  KeyTable found;
  std::vector<std::uint64_t> masks;
  std::vector<std::uint32_t> found_of;
  found_of.reserve(unordered.size());
  for (const VoxelKey& k : unordered) {
    const std::size_t b = found.insert(block_key_of(k));
    if (b == masks.size()) masks.push_back(0);
    masks[b] |= bit_of(k);
    found_of.push_back(static_cast<std::uint32_t>(b));
  }
  std::vector<std::uint32_t> order(masks.size()), rank(masks.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return found.keys()[a] < found.keys()[b]; });
  std::uint32_t count = 0;
  blocks_.reserve(masks.size());
  for (const std::uint32_t b : order) {
    rank[b] = static_cast<std::uint32_t>(block_table_.insert(found.keys()[b]));
    blocks_.push_back({masks[b], count, 0, {}});
    count += count_bits(masks[b]);
  }
  keys.resize(count);
  block_of_.resize(count);
  std::vector<int> place_of(unordered.size());
  for (std::size_t i = 0; i < unordered.size(); ++i) {
    const std::uint32_t b = rank[found_of[i]];
    const int at = place_of[i] = blocks_[b].first + count_bits(blocks_[b].mask & (bit_of(unordered[i]) - 1));
    keys[at] = unordered[i];
    block_of_[at] = b;
  }
  link_blocks(std::vector<int>(blocks_.size(), rings_within(kFirstReach)), context);
  return place_of;
}

void VoxelGrid::find_farther(const std::vector<int>& reach, const Context& context) {
  if (std::all_of(reach.begin(), reach.end(), [](int r) { return r <= kFirstReach; })) return;
  std::vector<int> rings(blocks_.size(), rings_within(kFirstReach));
  for (std::size_t i = 0; i < size(); ++i) {
    int& of_block = rings[block_of_[i]];
    of_block = std::max(of_block, rings_within(reach[i]));
  }
  link_blocks(rings, context);
}

std::vector<int> VoxelGrid::labels_of_blocks(const std::vector<int>& label_of_voxel) const {
  std::vector<int> labels(blocks_.size(), kNone);
  for (std::size_t i = 0; i < size(); ++i) {
    int& label = labels[block_of_[i]];
    if (label_of_voxel[i] == kNone || label_of_voxel[i] == label) continue;
    label = label == kNone ? label_of_voxel[i] : kSeveral;
  }
  return labels;
}

VoxelSet VoxelGrid::empty_set() const {
  VoxelSet set;
  set.bits_.assign(blocks_.size(), 0);
  return set;
}

VoxelKey VoxelGrid::key_of(const Vec3& p) const {
  const double scale = 1.0 / edge;
  return {static_cast<std::int32_t>(std::floor(p.x() * scale)), static_cast<std::int32_t>(std::floor(p.y() * scale)),
          static_cast<std::int32_t>(std::floor(p.z() * scale))};
}

Vec3 VoxelGrid::center_of(const VoxelKey& k) const { return Vec3(k[0] + 0.5, k[1] + 0.5, k[2] + 0.5) * edge; }

int VoxelGrid::find(const VoxelKey& key) const {
  const int b = block_table_.find(block_key_of(key));
  if (b < 0) return -1;
  const std::uint64_t bit = bit_of(key), mask = blocks_[b].mask;
  return mask & bit ? static_cast<int>(blocks_[b].first) + count_bits(mask & (bit - 1)) : -1;
}

VoxelGrid VoxelGrid::coarser(std::vector<int>& parent, const Context& context) const {
  LargeVector<VoxelKey> up;
  up.reserve(size());
  for (const VoxelKey& k : keys) up.push_back({k[0] >> 1, k[1] >> 1, k[2] >> 1});
  VoxelGrid grid;
  grid.edge = 2.0 * edge;
  grid.tolerance = tolerance;
  grid.rounding = rounding;
  grid.raster = raster;
  grid.pixel = pixel;
  grid.within = within;
  parent = grid.place(up, context);
  grid.moments.resize(grid.size());
  for (std::size_t i = 0; i < size(); ++i) grid.moments[parent[i]] += moments[i];
  return grid;
}

}  // namespace unseen::planes
