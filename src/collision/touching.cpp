// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/touching.h"

#include <cmath>

namespace unseen::collision {

std::vector<Touching> touchings(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b, const std::vector<Vec3>& directions) {
  constexpr int kSteps = 12;
  const double size = a.mass.extent + b.mass.extent, near_enough = 1e-4 * size;
  std::vector<Touching> all;
  for (const Vec3& direction : directions) {
    double distance = size;  // certainly apart: the gap is convex along the ray, so Newton's steps come down from one side
    for (int step = 0; step < kSteps; ++step) {
      const std::optional<Proximity> near = nearest(a, distance * direction, q_a, b, Vec3::Zero(), q_b, 0.01 * size);
      if (!near) break;
      const double slope = near->normal.dot(direction);
      if (std::abs(near->gap) < near_enough) {
        const Vec3 x = 0.5 * (near->point_a + near->point_b);
        all.push_back({distance * direction, x - distance * direction, x, near->normal});
        break;
      }
      if (slope < 1e-3) break;
      distance -= near->gap / slope;
    }
  }
  return all;
}

}  // namespace unseen::collision
