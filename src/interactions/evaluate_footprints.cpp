// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/evaluate_parts.h"

namespace unseen::interactions {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The part of a convex polygon to the left of the line from `a` to `b`.
std::vector<Vec2> left_of(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    if (dp >= 0.0) kept.push_back(p);
    if ((dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0)) kept.push_back(p + dp / (dp - dq) * (q - p));
  }
  return kept;
}

}  // namespace

std::vector<Vec2> footprint(const OrientedBox& box) {
  std::vector<Vec2> points, hull;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    points.push_back((box.center + box.axes * corner.cwiseProduct(box.half_size)).head<2>());
  }
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  // Lower chain, then upper chain (Andrew 1979).
  for (const bool lower : {true, false}) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (lower) std::reverse(points.begin(), points.end());
  }
  return hull;
}

double common_area(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  std::vector<Vec2> common = a;
  for (std::size_t i = 0; i < b.size() && !common.empty(); ++i) common = left_of(common, b[i], b[(i + 1) % b.size()]);
  double twice = 0;
  for (std::size_t i = 0; i < common.size(); ++i) twice += cross(common[i] - common[0], common[(i + 1) % common.size()] - common[0]);
  return 0.5 * twice;
}

}  // namespace unseen::interactions
