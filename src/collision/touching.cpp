// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/touching.h"

#include <cmath>

namespace unseen::collision {

std::optional<Touching> touch_along(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b, const Vec3& direction) {
  constexpr int kSteps = 12;
  const double size = a.mass.extent + b.mass.extent, near_enough = 1e-4 * size;
  double distance = size;  // certainly apart: the gap is convex along the ray, so Newton's steps come down from one side
  for (int step = 0; step < kSteps; ++step) {
    const std::optional<Proximity> near = nearest(a, distance * direction, q_a, b, Vec3::Zero(), q_b, 0.01 * size);
    if (!near) return std::nullopt;
    if (std::abs(near->gap) < near_enough) {
      const Vec3 x = 0.5 * (near->point_a + near->point_b);
      return Touching{distance * direction, x - distance * direction, x, near->normal};
    }
    const double slope = near->normal.dot(direction);
    if (slope < 1e-3) return std::nullopt;
    distance -= near->gap / slope;
  }
  return std::nullopt;
}

}  // namespace unseen::collision
