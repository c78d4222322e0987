// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/database/footprint.h"

#include <algorithm>
#include <limits>

#include "core/clip_convex.h"
#include "unseen/core/convex.h"

namespace unseen::interactions {
namespace {

constexpr double kLeastArea = 1e-12;  ///< m²; smaller pieces are rounding

/// The part of a convex polygon that lies left of the line a→b.
Polygon left_of(const Polygon& polygon, const Vec2& a, const Vec2& b) {
  const Polygon left = clip_convex(polygon, [&](const Vec2& p) { return cross(p - a, b - a); });
  return area(left) > kLeastArea ? left : Polygon{};
}

/// What of `polygon` lies outside `hole`, as convex polygons that do not overlap.
void subtract(Polygon polygon, const Polygon& hole, std::vector<Polygon>& pieces) {
  if (intersection(polygon, hole).empty()) {
    pieces.push_back(std::move(polygon));
    return;
  }
  for (std::size_t i = 0; i < hole.size() && !polygon.empty(); ++i) {
    const Vec2 &a = hole[i], &b = hole[(i + 1) % hole.size()];
    if (Polygon outside = left_of(polygon, b, a); !outside.empty()) pieces.push_back(std::move(outside));
    polygon = left_of(polygon, a, b);
  }
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (a + share * along - p).norm();
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

}  // namespace

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

Polygon intersection(const Polygon& a, const Polygon& b) {
  Polygon shared = a;
  for (std::size_t i = 0; i < b.size() && !shared.empty(); ++i) shared = left_of(shared, b[i], b[(i + 1) % b.size()]);
  return shared;
}

Polygon footprint(const OrientedBox& box) {
  const Vec2 center = box.center.head<2>(), u = box.half_size[0] * box.axes.col(0).head<2>(), v = box.half_size[1] * box.axes.col(1).head<2>();
  if (cross(u, v) < 0) return {center - u - v, center - u + v, center + u + v, center + u - v};
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

std::vector<Polygon> footprint(const Object& object) {
  std::vector<Polygon> all;
  for (const Part& part : object.parts) {
    const Polygon whole = footprint(part.box);
    if (area(whole) <= kLeastArea) continue;
    std::vector<Polygon> left = {whole};
    for (const Polygon& known : all) {
      std::vector<Polygon> pieces;
      for (Polygon& piece : left) subtract(std::move(piece), known, pieces);
      left = std::move(pieces);
    }
    all.insert(all.end(), left.begin(), left.end());
  }
  return all;
}

double distance(const Vec2& from, const Vec2& to, const Polygon& polygon) {
  if (inside_convex(polygon, from) || inside_convex(polygon, to)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (cross_each_other(from, to, a, b)) return 0;
    least = std::min({least, distance_to_segment(from, a, b), distance_to_segment(to, a, b), distance_to_segment(a, from, to)});
  }
  return least;
}

}  // namespace unseen::interactions
