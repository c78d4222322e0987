// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/search/problem.h"

namespace unseen::cuboids {

inline OrientedBox box(const Vec3& center, const Vec3& size, double yaw = 0.0) {
  return {center, Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), 0.5 * size};
}

inline Cuboid cuboid(const OrientedBox& b) {
  Cuboid c;
  c.initial = c.box = b;
  c.visible_points = 1000;
  return c;
}

/// Boxes over the ground, that touch within 6 mm.
inline Problem problem_of(const std::vector<OrientedBox>& boxes) {
  Problem problem;
  problem.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  for (const OrientedBox& b : boxes) problem.cuboids.push_back(cuboid(b));
  problem.tolerance.assign(boxes.size(), 0.006);
  return problem;
}

}  // namespace unseen::cuboids
