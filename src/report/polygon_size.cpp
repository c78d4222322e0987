// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/polygon_size.h"

#include <cmath>
#include <limits>

#include "unseen/core/convex.h"

namespace unseen::report {
namespace {

/// Sides of the bounding rectangle whose first side runs along unit vector `along`.
Vec2 sides_along(const Ring& points, const Vec2& along) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : points) box.extend(Vec2(along.dot(p), along.x() * p.y() - along.y() * p.x()));
  return box.sizes();
}

bool is_upright(const planes::ArrangedPlane& plane) {
  return plane.tag == "wall" || plane.tag == "vertical";
}

}  // namespace

Vec2 smallest_rectangle(const Ring& points) {
  const Ring hull = convex_hull(points);
  Vec2 best = Vec2::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0)) continue;
    const Vec2 sides = sides_along(hull, edge.normalized());
    if (sides.prod() < least) least = sides.prod(), best = sides;
  }
  return {best.maxCoeff(), best.minCoeff()};
}

PolygonSize polygon_size(const planes::ArrangedPlane& plane) {
  PolygonSize size;
  const Vec3& normal = plane.plane.normal;
  const bool upright = is_upright(plane);
  const Vec3 u = upright ? Vec3(Vec3::UnitZ().cross(normal).normalized()) : any_orthogonal(normal);
  const std::vector<Ring> rings = flat_rings(plane.polygon, u, normal.cross(u));
  if (rings.empty()) return size;
  const Ring& outline = rings[0];
  for (std::size_t i = 0; i < outline.size(); ++i)
    size.perimeter += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  const Vec2 sides = upright ? sides_along(outline, Vec2::UnitX()) : smallest_rectangle(outline);
  size.width = sides.x();
  size.height = sides.y();
  size.holes = rings.size() - 1;
  for (std::size_t r = 1; r < rings.size(); ++r) size.hole_area += std::abs(doubled_area(rings[r])) / 2;
  return size;
}

}  // namespace unseen::report
