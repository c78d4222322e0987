// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/views.h"

#include "core/linear.h"

namespace unseen::collision {

std::vector<Vec3> sphere_directions(int count) {
  std::vector<Vec3> all;
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    all.push_back({r * std::cos(golden * i), r * std::sin(golden * i), z});
  }
  return all;
}

std::vector<Quat> rotation_grid(int views, int turns) {
  std::vector<Quat> all;
  for (const Vec3& view : sphere_directions(views)) {
    const Quat to_axis = turn_between(view, Vec3::UnitZ());
    for (int i = 0; i < turns; ++i) all.push_back(Quat(Eigen::AngleAxisd(2.0 * kPi * i / turns, Vec3::UnitZ())) * to_axis);
  }
  return all;
}

}  // namespace unseen::collision
