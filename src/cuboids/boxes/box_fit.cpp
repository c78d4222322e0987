// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/box_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "cuboids/boxes/box_axes.h"
#include "cuboids/boxes/outline.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

const double kFaceCosine = std::cos(radians(20.0));
constexpr double kEndSlack = 0.02, kEndSigmas = 1.0, kSlackShare = 0.25;  // m, and of the extent: points that fly beyond a face
constexpr double kOfSide = 0.15;            // of a side's area: a smaller face is a dent or noise
constexpr double kSliceQuantile = 0.9;
constexpr double kStripStep = 3.0;          // spacings or noise, without a point of a strip
constexpr std::size_t kStripPoints = 4;     // within such a step
constexpr double kAsNear = 0.02;            // share of the points that lie on a box: one along other axes explains as much,
constexpr double kAsTight = 1.3;            // if it is hardly larger

/// Where the points end along axis k on the given side: each slice along axis m ends at its outermost points.
double end_of(const Observation& seen, std::span<const int> points, const Mat3& axes, int k, int m, double sign) {
  double low = std::numeric_limits<double>::infinity(), high = -low, spacing = 0;
  for (const int i : points) {
    const double along = axes.col(m).dot(seen.points[i]);
    low = std::min(low, along);
    high = std::max(high, along);
    spacing += seen.graph.spacing[i];
  }
  spacing /= static_cast<double>(points.size());
  const double width = std::max({2.5 * spacing, (high - low) / 400.0, 1e-6});
  std::vector<std::array<double, 2>> best(static_cast<std::size_t>((high - low) / width) + 1, {-1e30, -1e30});
  std::vector<int> count(best.size(), 0);
  for (const int i : points) {
    const std::size_t slice = static_cast<std::size_t>((axes.col(m).dot(seen.points[i]) - low) / width);
    const double value = sign * axes.col(k).dot(seen.points[i]);
    auto& [first, second] = best[slice];
    if (value > first) second = first, first = value;
    else if (value > second) second = value;
    ++count[slice];
  }
  std::vector<double> ends;
  for (std::size_t s = 0; s < best.size(); ++s)
    if (count[s] >= 3) ends.push_back(best[s][1]);
  if (ends.empty())
    for (const auto& b : best) ends.push_back(b[0]);
  return sign * (quantile(ends, kSliceQuantile) + 0.5 * spacing);
}

/// Where a strip of the top ends that runs on from `end`: where something stands on it, often no more is seen than a strip along an edge.
double end_of_strip(const Observation& seen, std::span<const Face* const> faces, const Vec3& out, double end) {
  std::vector<double> beyond;
  double step = 0;
  for (const Face* face : faces) {
    if (std::abs(face->plane.normal.dot(out)) > kUprightSine || face->plane.normal.z() < kFaceCosine) continue;
    for (const int i : face->points)
      if (const double at = out.dot(seen.points[i]); at > end) {
        beyond.push_back(at);
        step += kStripStep * std::max(seen.graph.spacing[i], seen.graph.sigma[i]);
      }
  }
  if (beyond.empty()) return end;
  step /= static_cast<double>(beyond.size());
  std::sort(beyond.begin(), beyond.end());
  if (beyond.front() > end + step) return end;
  std::size_t last = 0;
  while (last + kStripPoints < beyond.size() && beyond[last + kStripPoints] - beyond[last] < step) ++last;
  return last > 0 && beyond[last] > end + 2.0 * step ? beyond[last] : end;
}

}  // namespace

OrientedBox bound(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                  double voxel) {
  Vec3 low, high, extent, middle;
  for (int k = 0; k < 3; ++k) {
    double smallest = std::numeric_limits<double>::infinity(), greatest = -smallest;
    for (const int i : points) {
      smallest = std::min(smallest, axes.col(k).dot(seen.points[i]));
      greatest = std::max(greatest, axes.col(k).dot(seen.points[i]));
    }
    extent[k] = greatest - smallest;
    middle[k] = 0.5 * (greatest + smallest);
  }
  const Vec3 viewpoint = axes.transpose() * seen.T_world_camera.translation;
  Vec3 lean = Vec3::Zero();
  lean.head<2>() = lean_of_outline(seen, view, faces, axes);
  double near = kEndSlack;
  for (const int i : points) near += kEndSigmas * seen.graph.sigma[i] / static_cast<double>(points.size());
  for (int k = 0; k < 3; ++k) {
    // What leans as a whole, or is skewed, is as wide as it is at each height.
    Mat3 skewed = axes;
    skewed.col(k) -= lean[k] * axes.col(2);
    for (const double sign : {-1.0, 1.0}) {
      // A side seen edge on ends the slices along one of the other axes, not along both.
      double end = lean[k] * middle.z() + sign * std::max(sign * end_of(seen, points, skewed, k, (k + 1) % 3, sign),
                                                          sign * end_of(seen, points, skewed, k, (k + 2) % 3, sign));
      double largest = 0;
      for (const Face* face : faces) largest = std::max(largest, sign * axes.col(k).dot(face->plane.normal) > kFaceCosine ? face->area : 0.0);
      // The outermost of the large faces that look this way; one that is small for the side only where the points end too.
      double outermost = -std::numeric_limits<double>::infinity();
      const double side = extent[(k + 1) % 3] * extent[(k + 2) % 3];
      for (const Face* face : faces) {
        const double at = sign * axes.col(k).dot(face->center), slack = near + (face->area > kOfSide * side ? kSlackShare * extent[k] : 0.0);
        if (sign * axes.col(k).dot(face->plane.normal) > kFaceCosine && face->area > 0.3 * largest && sign * end - at < slack)
          outermost = std::max(outermost, at);
      }
      end = std::isfinite(outermost) ? sign * outermost : sign * end_of_strip(seen, faces, sign * axes.col(k), sign * end);
      (sign < 0 ? low : high)[k] = end;
    }
    if (high[k] - low[k] < voxel) {  // thin: what is behind the seen side is not known
      const double middle = 0.5 * (low[k] + high[k]), side = viewpoint[k] > middle ? 1.0 : -1.0;
      (side > 0 ? low : high)[k] = (side > 0 ? high : low)[k] - side * voxel;
    }
  }
  OrientedBox box;
  box.axes = axes;
  box.center = axes * (0.5 * (low + high));
  box.half_size = 0.5 * (high - low);
  return box;
}

double mean_sigma(const Observation& seen, std::span<const int> points) {
  double sum = 0;
  for (const int i : points) sum += seen.graph.sigma[i];
  return sum / static_cast<double>(points.size());
}

double share_on_surface(const Observation& seen, std::span<const int> points, const OrientedBox& box, double sigmas) {
  std::size_t count = 0;
  for (const int i : points) {
    const Vec3 beyond = (box.axes.transpose() * (seen.points[i] - box.center)).cwiseAbs() - box.half_size;
    count += std::abs(beyond.maxCoeff()) < sigmas * seen.graph.sigma[i];
  }
  return static_cast<double>(count) / static_cast<double>(points.size());
}

OrientedBox bound_along(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& own,
                        const Mat3& whole, double voxel) {
  const OrientedBox box = bound(seen, view, points, faces, own, voxel), parallel = bound(seen, view, points, faces, whole, voxel);
  const auto near = [&](const OrientedBox& b) { return share_on_surface(seen, points, b, kNearSurface); };
  return near(parallel) >= near(box) - kAsNear && parallel.half_size.prod() <= kAsTight * box.half_size.prod() ? parallel : box;
}

}  // namespace unseen::cuboids
