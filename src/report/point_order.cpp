// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/point_order.h"

#include <algorithm>
#include <cstdint>

#include "core/linear.h"

namespace unseen::report {
namespace {

constexpr std::size_t kGroup = 24, kGroups = 4000;  // points of a group, and how many groups

/// Spreads 16 bits so that two zeros follow each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 32)) & 0x1f00000000ffffull;
  x = (x | (x << 16)) & 0x1f0000ff0000ffull;
  x = (x | (x << 8)) & 0x100f00f00f00f00full;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3ull;
  return (x | (x << 2)) & 0x1249249249249249ull;
}

}  // namespace

OrderedPoints ordered(const PointSample& sample, std::size_t plane_count) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : sample.positions) box.extend(p);
  const double step = sample.positions.empty() ? 1.0 : std::max(box.sizes().maxCoeff() / 65535.0, 1e-300);
  struct Key {
    std::int32_t plane;
    std::uint32_t index;
    std::uint64_t place;  // Morton code
  };
  std::vector<Key> keys;
  keys.reserve(sample.positions.size());
  for (std::size_t i = 0; i < sample.positions.size(); ++i) {
    const Vec3 at = (sample.positions[i] - box.min()) / step;
    keys.push_back({sample.plane_of_point[i], static_cast<std::uint32_t>(i),
                    spread(static_cast<std::uint64_t>(at.x())) << 2 | spread(static_cast<std::uint64_t>(at.y())) << 1 |
                        spread(static_cast<std::uint64_t>(at.z()))});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.plane, a.place, a.index) < std::tie(b.plane, b.place, b.index);
  });
  OrderedPoints points;
  points.positions.reserve(keys.size());
  points.plane.reserve(keys.size());
  for (const Key& key : keys) {
    points.positions.push_back(sample.positions[key.index]);
    points.plane.push_back(key.plane);
  }
  for (std::size_t p = 0; p <= plane_count; ++p)
    points.first.push_back(static_cast<std::size_t>(
        std::lower_bound(points.plane.begin(), points.plane.end(), static_cast<int>(p)) - points.plane.begin()));
  return points;
}

Plane fitted_plane(std::span<const Vec3> points, std::optional<int> flat) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& p : points) scatter += (p - mean) * (p - mean).transpose();
  if (flat) scatter(*flat, *flat) = 2.0 * scatter.trace() + 1.0;  // beyond the others: the last axis, not the normal
  const Vec3 normal = symmetric_eigen(scatter).vectors.col(0);
  return {normal, normal.dot(mean)};
}

std::vector<Vec3> local_normals(const OrderedPoints& points, std::optional<int> flat) {
  std::vector<Vec3> normals;
  const std::size_t n = points.positions.size();
  const std::size_t step = std::max(kGroup, n / kGroups);
  for (std::size_t first = 0; first + kGroup <= n; first += step) {
    if (points.plane[first] != points.plane[first + kGroup - 1]) continue;
    normals.push_back(fitted_plane(std::span(points.positions).subspan(first, kGroup), flat).normal);
  }
  return normals;
}

}  // namespace unseen::report
