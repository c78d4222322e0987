// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/voxels.h"

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

bool block_order(const VoxelKey& a, const VoxelKey& b) {
  const auto block = [](const VoxelKey& k) { return VoxelKey{k[0] >> 2, k[1] >> 2, k[2] >> 2}; };
  const VoxelKey ba = block(a), bb = block(b);
  return ba != bb ? ba < bb : a < b;
}

}  // namespace

VoxelSums& VoxelSums::operator+=(const VoxelSums& o) {
  count += o.count;
  for (int i = 0; i < 3; ++i) first[i] += o.first[i];
  for (int i = 0; i < 6; ++i) second[i] += o.second[i];
  for (int i = 0; i < 6; ++i) normal[i] += o.normal[i];
  return *this;
}

void VoxelBuilder::add(const PointCloud& block, const std::vector<bool>& skip) {
  const double scale = 1.0 / edge_;
  VoxelKey last{};
  std::size_t at = 0;
  bool have_last = false;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Vec3& p = block.positions[i];
    if (!p.allFinite() || (!skip.empty() && skip[i])) continue;
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
    if (!have_last || key != last) {
      at = slot(key);
      last = key;
      have_last = true;
    }
    VoxelSums& sums = sums_[at];
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

void VoxelBuilder::join(const VoxelBuilder& other) {
  for (std::size_t i = 0; i < other.keys_.size(); ++i) sums_[slot(other.keys_[i])] += other.sums_[i];
}

std::size_t VoxelBuilder::slot(const VoxelKey& key) {
  if (2 * (keys_.size() + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = hash(key) & mask;; i = (i + 1) & mask) {
    if (table_[i] == 0) {
      keys_.push_back(key);
      sums_.emplace_back();
      table_[i] = static_cast<std::uint32_t>(keys_.size());
      return keys_.size() - 1;
    }
    if (keys_[table_[i] - 1] == key) return table_[i] - 1;
  }
}

void VoxelBuilder::grow() {
  table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), 0);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    std::size_t i = hash(keys_[k]) & mask;
    while (table_[i] != 0) i = (i + 1) & mask;
    table_[i] = static_cast<std::uint32_t>(k + 1);
  }
}

std::size_t VoxelGrid::KeyHash::operator()(const VoxelKey& k) const { return hash(k); }

VoxelGrid::VoxelGrid(const VoxelBuilder& builder) : edge(builder.edge()) {
  const std::size_t n = builder.keys().size();
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return block_order(builder.keys()[a], builder.keys()[b]);
  });
  keys.reserve(n);
  moments.reserve(n);
  bool any_normals = false;
  for (const VoxelSums& s : builder.sums()) any_normals = any_normals || (s.normal[0] + s.normal[3] + s.normal[5] > 0);
  const double unit = edge / kSteps;
  for (const std::uint32_t i : order) {
    const VoxelKey& key = builder.keys()[i];
    const VoxelSums& s = builder.sums()[i];
    const double count = static_cast<double>(s.count);
    // Quantisation rounds down, half a step on average.
    const Vec3 q(s.first[0] / count, s.first[1] / count, s.first[2] / count);
    Moments m;
    m.count = count;
    m.mean = Vec3(key[0], key[1], key[2]) * edge + (q + Vec3::Constant(0.5)) * unit;
    m.scatter = symmetric(s.second, unit * unit) - count * unit * unit * q * q.transpose();
    keys.push_back(key);
    moments.push_back(m);
    if (any_normals) normals.push_back(symmetric(s.normal, 1.0 / (kNormalSteps * kNormalSteps)));
  }
  index_blocks();
}

void VoxelGrid::index_blocks() {
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const VoxelKey& k = keys[i];
    const VoxelKey block = {k[0] >> 2, k[1] >> 2, k[2] >> 2};
    if (blocks_.empty() || blocks_.back().key != block) {
      block_of_key_.emplace(block, static_cast<std::int32_t>(blocks_.size()));
      blocks_.push_back({block, 0, i, {}});
    }
    blocks_.back().mask |= std::uint64_t{1} << (((k[0] & 3) << 4) | ((k[1] & 3) << 2) | (k[2] & 3));
  }
  for (Block& b : blocks_)
    for (int n = 0; n < 27; ++n) b.around[n] = block_at({b.key[0] + n / 9 - 1, b.key[1] + n / 3 % 3 - 1, b.key[2] + n % 3 - 1});
}

int VoxelGrid::block_at(const VoxelKey& block_key) const {
  const auto it = block_of_key_.find(block_key);
  return it == block_of_key_.end() ? -1 : it->second;
}

VoxelKey VoxelGrid::key_of(const Vec3& p) const {
  const double scale = 1.0 / edge;
  return {static_cast<std::int32_t>(std::floor(p.x() * scale)), static_cast<std::int32_t>(std::floor(p.y() * scale)),
          static_cast<std::int32_t>(std::floor(p.z() * scale))};
}

Vec3 VoxelGrid::center_of(const VoxelKey& k) const { return Vec3(k[0] + 0.5, k[1] + 0.5, k[2] + 0.5) * edge; }

int VoxelGrid::find(const VoxelKey& key) const {
  int found = -1;
  for_neighbours(key, 0, [&](int i) { found = i; });
  return found;
}

VoxelGrid VoxelGrid::coarser(std::vector<int>& parent) const {
  const auto up = [](const VoxelKey& k) { return VoxelKey{k[0] >> 1, k[1] >> 1, k[2] >> 1}; };
  VoxelGrid grid;
  grid.edge = 2.0 * edge;
  for (const VoxelKey& k : keys) grid.keys.push_back(up(k));
  std::sort(grid.keys.begin(), grid.keys.end(), block_order);
  grid.keys.erase(std::unique(grid.keys.begin(), grid.keys.end()), grid.keys.end());
  grid.index_blocks();
  grid.moments.resize(grid.size());
  if (!normals.empty()) grid.normals.assign(grid.size(), Mat3::Zero());
  parent.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const int p = parent[i] = grid.find(up(keys[i]));
    grid.moments[p] += moments[i];
    if (!normals.empty()) grid.normals[p] += normals[i];
  }
  return grid;
}

VoxelBuilder summarise(PointSource& source, double edge, const std::vector<bool>& duplicate, Context& context) {
  VoxelBuilder builder(edge);
  const double total = static_cast<double>(source.info().point_count.value_or(0));
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    builder.add(block, duplicate);
    context.progress(total > 0 ? std::min(1.0, (first + block.size()) / total) : 0.0);
  });
  return builder;
}

}  // namespace unseen::planes
