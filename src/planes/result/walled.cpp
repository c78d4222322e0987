// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/walled.h"

#include <algorithm>
#include <cmath>

#include "unseen/core/convex.h"

namespace unseen::planes {
namespace {

constexpr double kAside = 0.1;  // of the level plane's width: how far from its edge a wall may stand
constexpr int kSteps = 64;      // around it
constexpr double kHeights[] = {0.25, 0.6, 0.9};
constexpr int kMost = 2;  // of these heights that a wall has: beside windows, doors and furniture

}  // namespace

Wall wall_of(const ArrangedPlane& plane, const Vec3& up) {
  const Vec3 along = up.cross(plane.plane.normal).normalized();
  return {plane.plane, along, rings_of(plane, along, up)};
}

double walled_share(const ArrangedPlane& level, double height, const Vec3& up, const std::vector<Wall>& walls) {
  if (level.polygon.empty() || level.polygon.front().empty()) return 0.0;
  const Vec3 u = any_orthogonal(up), v = up.cross(u);
  std::vector<Vec2> corners;
  for (const Vec3& c : level.polygon.front()) corners.emplace_back(u.dot(c), v.dot(c));
  corners = convex_hull(std::move(corners));
  double around = 0, walled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) around += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  if (!(around > 0)) return 0.0;
  const double aside = kAside * std::sqrt(level.area);
  const Plane& plane = level.plane;
  const auto is_walled = [&](const Vec2& at) {
    const Vec3 below = at.x() * u + at.y() * v;
    const double bottom = (plane.offset - plane.normal.dot(below)) / plane.normal.dot(up);
    const Vec3 foot = below + bottom * up;
    return std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) {
      if (std::abs(wall.plane.signed_distance(foot)) > aside) return false;
      return std::count_if(std::begin(kHeights), std::end(kHeights), [&](double h) { return wall.rings.contains({wall.along.dot(foot), bottom + h * height}); }) >= kMost;
    });
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &from = corners[i], edge = corners[(i + 1) % corners.size()] - from;
    const int steps = 1 + static_cast<int>(kSteps * edge.norm() / around);
    for (int k = 0; k < steps; ++k)
      if (is_walled(from + (k + 0.5) / steps * edge)) walled += edge.norm() / steps;
  }
  return walled / around;
}

}  // namespace unseen::planes
