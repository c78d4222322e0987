// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/voxel_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace

VoxelSums& VoxelSums::operator+=(const VoxelSums& o) {
  count += o.count;
  for (int i = 0; i < 3; ++i) first[i] += o.first[i];
  for (int i = 0; i < 6; ++i) second[i] += o.second[i];
  for (int i = 0; i < 6; ++i) normal[i] += o.normal[i];
  return *this;
}

Moments moments_of(const VoxelSums& sums, const VoxelKey& key, double edge) {
  const double count = static_cast<double>(sums.count), unit = edge / kSteps;
  const Vec3 q(sums.first[0] / count, sums.first[1] / count, sums.first[2] / count);
  // Quantisation rounds down, half a step on average.
  return {count, Vec3(key[0], key[1], key[2]) * edge + (q + Vec3::Constant(0.5)) * unit, symmetric(sums.second, unit * unit) - count * unit * unit * q * q.transpose()};
}

Mat3 normals_of(const VoxelSums& sums) { return symmetric(sums.normal, 1.0 / (kNormalSteps * kNormalSteps)); }

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
