// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/foot.h"

#include "cuboids/slabs.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kBelowFoot = 0.02;      // of the points
constexpr double kFootSigmas = 2.0;      // height of the foot
constexpr double kAboveFoot = 0.7;       // of the points, of what is no flat thing
constexpr double kNarrower = 0.95;       // of the volume
constexpr double kClearlyFuller = 0.02;  // of its own volume

std::vector<int> above_foot(const Observation& seen, std::span<const int> points, const Vec3& up) {
  std::vector<double> heights;
  for (const int i : points) heights.push_back(up.dot(seen.points[i]));
  const double foot = quantile(heights, kBelowFoot);
  std::vector<int> above;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (heights[k] > foot + kFootSigmas * seen.graph.sigma[points[k]]) above.push_back(points[k]);
  return above;
}

}  // namespace

OrientedBox bound_above_foot(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                             double voxel) {
  const OrientedBox box = bound(seen, view, points, faces, axes, voxel);
  const Vec3 up = axes.col(2);
  const std::vector<int> above = above_foot(seen, points, up);
  if (static_cast<double>(above.size()) < kAboveFoot * static_cast<double>(points.size())) return box;
  OrientedBox narrow = bound(seen, view, above, faces, axes, voxel);
  narrow.center += up * up.dot(box.center - narrow.center);
  narrow.half_size.z() = box.half_size.z();
  if (narrow.half_size.prod() > kNarrower * box.half_size.prod()) return box;
  return filled_share(view, narrow, voxel) > filled_share(view, box, voxel) + kClearlyFuller ? narrow : box;
}

}  // namespace unseen::cuboids
