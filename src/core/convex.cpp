// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/convex.h"

#include <algorithm>

namespace unseen {

std::vector<Vec2> convex_hull(std::vector<Vec2> points, double flat) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= flat) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the other side begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool inside_convex(std::span<const Vec2> polygon, const Vec2& p, double margin) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 side = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (cross(side, p - polygon[i]) < -margin * side.norm()) return false;
  }
  return !polygon.empty();
}

}  // namespace unseen
