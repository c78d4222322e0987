// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <span>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Along and across the front of something, and up.
struct Directions {
  Vec2 along;
  Vec3 operator()(const Vec3& p) const { return {along.dot(p.head<2>()), along.x() * p.y() - along.y() * p.x(), p.z()}; }
};

/// As far as points reach in some directions.
struct DirectedExtent {
  Vec3 low, high;
  double room = 0;  ///< m, tolerance: 3σ of the first point

  bool holds(const Vec3& p) const { return (p.array() >= low.array() - room).all() && (p.array() <= high.array() + room).all(); }
  bool has_on_side(const Vec3& p) const { return holds(p) && std::min((p - low).cwiseAbs().minCoeff(), (p - high).cwiseAbs().minCoeff()) < room; }
};

/// Of some points (one at least), but for the outermost.
DirectedExtent extent_of(const Observation& seen, const Directions& directions, std::span<const int> points);

/// How many of the points (one at least) are in an extent, 0 … 1.
double share_within(const Observation& seen, const Directions& directions, const DirectedExtent& extent, std::span<const int> points);

}  // namespace unseen::cuboids
