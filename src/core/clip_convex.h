// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <vector>

namespace unseen {

/// The part of a convex polygon (of 2 corners or more, in any order of turning) where `height`, linear in the point, is at most 0
/// (Sutherland and Hodgman 1974).
template <class Point, class Height>
std::vector<Point> clip_convex(const std::vector<Point>& polygon, const Height& height) {
  std::vector<Point> kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double at_p = height(p), at_q = height(q);
    if (at_p <= 0.0) kept.push_back(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

}  // namespace unseen
