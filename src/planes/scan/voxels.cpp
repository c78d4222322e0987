// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr double kSteps = 1 << 18;        // positions within a voxel
constexpr double kNormalSteps = 1 << 14;  // components of a unit normal

std::uint64_t hash(const VoxelKey& k) {
  std::uint64_t h = static_cast<std::uint32_t>(k[0]) * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 29) ^ static_cast<std::uint32_t>(k[1])) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(k[2])) * 0x94D049BB133111EBull;
  return h ^ (h >> 31);
}

template <class V>
void add_outer(std::array<std::int64_t, 6>& sum, const V& q) {
  sum[0] += q[0] * q[0];
  sum[1] += q[0] * q[1];
  sum[2] += q[0] * q[2];
  sum[3] += q[1] * q[1];
  sum[4] += q[1] * q[2];
  sum[5] += q[2] * q[2];
}

Mat3 symmetric(const std::array<std::int64_t, 6>& s, double unit) {
  Mat3 m;
  m << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  return m * unit;
}

VoxelKey block_key_of(const VoxelKey& k) { return {k[0] >> 2, k[1] >> 2, k[2] >> 2}; }

}  // namespace

VoxelSums& VoxelSums::operator+=(const VoxelSums& o) {
  count += o.count;
  for (int i = 0; i < 3; ++i) first[i] += o.first[i];
  for (int i = 0; i < 6; ++i) second[i] += o.second[i];
  for (int i = 0; i < 6; ++i) normal[i] += o.normal[i];
  return *this;
}

void VoxelBuilder::add(const PointCloud& block, const std::vector<bool>& skip, std::size_t first) {
  const double scale = 1.0 / edge_;
  VoxelKey last{};
  VoxelSums* at = nullptr;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Vec3& p = block.positions[i];
    if (!within_.contains(p)) {
      outside_ += p.allFinite();
      continue;
    }
    if (!skip.empty() && skip[first + i]) continue;
    VoxelKey key;
    std::array<std::int64_t, 3> q;
    for (int a = 0; a < 3; ++a) {
      const double cells = p[a] * scale, cell = std::floor(cells);
      if (std::abs(cell) > 2147483000.0)
        throw InputError("", "scale", fmt::format("{} m for a coordinate of {} m", 2.0 * edge_, p[a]),
                         "a scale of at least a billionth of the coordinates");
      key[a] = static_cast<std::int32_t>(cell);
      q[a] = static_cast<std::int64_t>((cells - cell) * kSteps);
    }
    if (at == nullptr || key != last) {
      at = &sums_of(key);
      last = key;
    }
    VoxelSums& sums = *at;
    ++sums.count;
    for (int a = 0; a < 3; ++a) sums.first[a] += q[a];
    add_outer(sums.second, q);
    if (block.normals.empty()) continue;
    const Vec3 n = block.normals[i].cast<double>();
    const double length = n.norm();
    if (!(length > 0.5) || !(length < 2.0)) continue;
    std::array<std::int64_t, 3> m;
    for (int a = 0; a < 3; ++a) m[a] = std::llround(n[a] / length * kNormalSteps);
    add_outer(sums.normal, m);
  }
}

void VoxelBuilder::reserve(std::size_t voxels) {
  table_.reserve(voxels);
  sums_.reserve(voxels);
}

void VoxelBuilder::join(const VoxelBuilder& other) {
  outside_ += other.outside_;
  for (std::size_t i = 0; i < other.sums_.size(); ++i) sums_of(other.keys()[i]) += other.sums_[i];
}

VoxelSums& VoxelBuilder::sums_of(const VoxelKey& key) {
  const std::size_t at = table_.insert(key);
  if (at == sums_.size()) sums_.emplace_back();
  return sums_[at];
}

std::size_t KeyTable::slot(const VoxelKey& key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash(key) & mask;
  while (slots_[i] != 0 && keys_[slots_[i] - 1] != key) i = (i + 1) & mask;
  return i;
}

int KeyTable::find(const VoxelKey& key) const {
  return slots_.empty() ? -1 : static_cast<int>(slots_[slot(key)]) - 1;
}

std::size_t KeyTable::insert(const VoxelKey& key) {
  if (2 * (keys_.size() + 1) > slots_.size()) grow();
  const std::size_t at = slot(key);
  if (slots_[at] == 0) {
    keys_.push_back(key);
    slots_[at] = static_cast<std::uint32_t>(keys_.size());
  }
  return slots_[at] - 1;
}

void KeyTable::grow() {
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), 0);
  for (std::size_t k = 0; k < keys_.size(); ++k) slots_[slot(keys_[k])] = static_cast<std::uint32_t>(k + 1);
}

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
  bool any_normals = false;
  for (const VoxelSums& s : builder.sums()) any_normals = any_normals || (s.normal[0] + s.normal[3] + s.normal[5] > 0);
  if (any_normals) normals.resize(size());
  const double unit = edge / kSteps;
  for (std::size_t i = 0; i < size(); ++i) {
    const VoxelKey& key = builder.keys()[i];
    const VoxelSums& s = builder.sums()[i];
    const double count = static_cast<double>(s.count);
    // Quantisation rounds down, half a step on average.
    const Vec3 q(s.first[0] / count, s.first[1] / count, s.first[2] / count);
    Moments& m = moments[place_of[i]];
    m.count = count;
    m.mean = Vec3(key[0], key[1], key[2]) * edge + (q + Vec3::Constant(0.5)) * unit;
    m.scatter = symmetric(s.second, unit * unit) - count * unit * unit * q * q.transpose();
    if (any_normals) normals[place_of[i]] = symmetric(s.normal, 1.0 / (kNormalSteps * kNormalSteps)).cast<float>();
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
  grid.within = within;
  parent = grid.place(up, context);
  grid.moments.resize(grid.size());
  for (std::size_t i = 0; i < size(); ++i) grid.moments[parent[i]] += moments[i];
  return grid;
}

VoxelBuilder summarise(PointSource& source, double edge, const Box& within, const std::vector<bool>& duplicate,
                       Context& context) {
  constexpr std::size_t kMostReserved = std::size_t{1} << 20;
  VoxelBuilder builder(edge, within);
  builder.reserve(std::min<std::size_t>(source.info().point_count.value_or(0), kMostReserved));
  const double total = static_cast<double>(source.info().point_count.value_or(0));
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    builder.add(block, duplicate, first);
    context.progress(total > 0 ? std::min(1.0, (first + block.size()) / total) : 0.0);
  });
  return builder;
}

}  // namespace unseen::planes
