// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/rotation.h"

namespace unseen::collision {

std::pair<Eigen::Quaterniond, Eigen::Matrix3d> turned_with_derivative(const Eigen::Quaterniond& q, const Eigen::Vector3d& h,
                                                                      const Eigen::Vector3d& inertia, double dt) {
  // central differences: of fourth-order steps in plain numbers, faster than carrying derivatives through them
  const double step = 1e-4 * (h.norm() + 1e-3 * inertia.maxCoeff());
  Eigen::Matrix3d along;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(i);
    const Eigen::Quaterniond more = turned<double>(q, h + d, inertia, dt), less = turned<double>(q, h - d, inertia, dt);
    along.col(i) = rotation_vector<double>(more * less.conjugate()) / (2.0 * step);
  }
  return {turned<double>(q, h, inertia, dt), along};
}

}  // namespace unseen::collision
