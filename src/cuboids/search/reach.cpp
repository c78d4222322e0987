// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <limits>

#include "cuboids/search/problem.h"
#include "cuboids/search/reach.h"
#include "cuboids/statics/clip.h"

namespace unseen::cuboids {
namespace {

constexpr double kParallel = 1e-6;
constexpr double kInset = 0.05, kMostInset = 0.5;  // of a half size: bodies flush with the sides of the swept space are not in it

}  // namespace

std::optional<double> reach(const OrientedBox& box, int face, const ConvexSolid& other, double tolerance) {
  const Vec3 direction = face_normal(box, face);
  const double start = direction.dot(box.center) + box.half_size[face / 2];
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const std::vector<int>& loop : other.faces) {
    std::vector<Vec3> polygon;
    for (const int v : loop) polygon.push_back(other.vertices[v]);
    for (int side = 0; side < 3; ++side) {
      if (side == face / 2) continue;
      const Vec3 axis = box.axes.col(side);
      const double inset = std::clamp(tolerance, kInset * box.half_size[side], kMostInset * box.half_size[side]);
      const double middle = axis.dot(box.center), half = box.half_size[side] - inset;
      polygon = clip(polygon, {axis, middle + half});
      polygon = clip(polygon, {-axis, -middle + half});
    }
    for (const Vec3& p : polygon) {
      nearest = std::min(nearest, direction.dot(p) - start);
      farthest = std::max(farthest, direction.dot(p) - start);
    }
  }
  // A body that lies behind the face altogether is not met by moving it, nor one that reaches through the box.
  if (nearest > farthest || farthest < 0.0 || nearest < -box.half_size[face / 2]) return std::nullopt;
  return std::max(0.0, nearest);
}

std::optional<double> reach(const OrientedBox& box, int face, const Support& other) {
  const Vec3 direction = face_normal(box, face);
  const double towards = -direction.dot(other.plane.normal);
  if (towards < kParallel) return std::nullopt;
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<Vec3> shadow;  // of the face on the plane, along its way
  for (int i = 0; i < 4; ++i) {
    const std::array<double, 2> sides = {i == 0 || i == 3 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0};
    Vec3 p = box.center + direction * box.half_size[face / 2];
    for (int k = 0; k < 2; ++k) {
      const int side = (face / 2 + 1 + k) % 3;
      p += sides[k] * box.half_size[side] * box.axes.col(side);
    }
    const double distance = other.plane.signed_distance(p);
    lowest = std::min(lowest, distance);
    shadow.push_back(p + distance / towards * direction);
  }
  for (std::size_t i = 0; i < other.outline.size(); ++i) {
    const Vec3 outward = (other.outline[(i + 1) % other.outline.size()] - other.outline[i]).cross(other.plane.normal);
    shadow = clip(shadow, {outward, outward.dot(other.outline[i])});
  }
  if (shadow.empty()) return std::nullopt;
  return std::max(0.0, lowest / towards);
}

}  // namespace unseen::cuboids
