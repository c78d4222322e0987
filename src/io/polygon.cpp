// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/polygon.h"

#include <cmath>

namespace unseen::io {
namespace {

/// The corners in the plane of the polygon, counter-clockwise.
std::vector<Vec2> flatten(const std::vector<std::uint32_t>& corners, const TriangleMesh& mesh) {
  Vec3 normal = Vec3::Zero();
  const Vec3 origin = mesh.vertices[corners[0]];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += (mesh.vertices[corners[i]] - origin).cross(mesh.vertices[corners[i + 1]] - origin);
  const double length = normal.norm();
  normal = length > 0.0 && std::isfinite(length) ? Vec3(normal / length) : Vec3::UnitZ();
  const Vec3 u = any_orthogonal(normal), v = normal.cross(u);
  std::vector<Vec2> flat;
  for (const std::uint32_t corner : corners) {
    const Vec3 p = mesh.vertices[corner] - origin;
    flat.emplace_back(p.dot(u), p.dot(v));
  }
  return flat;
}

bool is_ear(const std::vector<Vec2>& p, std::size_t i) {
  const std::size_t n = p.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  if (!(turn(p[before], p[i], p[after]) > 0.0)) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (k == before || k == i || k == after) continue;
    if (p[k] == p[before] || p[k] == p[i] || p[k] == p[after]) continue;
    if (turn(p[before], p[i], p[k]) >= 0.0 && turn(p[i], p[after], p[k]) >= 0.0 &&
        turn(p[after], p[before], p[k]) >= 0.0)
      return false;
  }
  return true;
}

}  // namespace

void append_polygon(const std::vector<std::uint32_t>& corners, TriangleMesh& mesh) {
  if (corners.size() < 3) return;
  std::vector<std::uint32_t> left = corners;
  std::vector<Vec2> flat;
  if (left.size() > 3) flat = flatten(corners, mesh);
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(flat, ear)) ++ear;
    if (ear == left.size()) break;  // crosses itself or has no area: the rest becomes a fan
    const std::size_t n = left.size();
    mesh.triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    flat.erase(flat.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) mesh.triangles.push_back({left[0], left[i], left[i + 1]});
}

}  // namespace unseen::io
