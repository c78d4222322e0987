// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/rotation.h"

namespace unseen::collision {

std::vector<TurnedEnd> turned_through(const Eigen::Quaterniond& q, const Eigen::Vector3d& h, const Eigen::Vector3d& inertia,
                                      const std::vector<double>& times, bool derivatives) {
  // central differences: of fourth-order steps in plain numbers, faster than carrying derivatives through them
  const double step = 1e-4 * (h.norm() + 1e-3 * inertia.maxCoeff());
  std::vector<TurnedEnd> ends(times.size());
  const auto follow = [&](const Eigen::Vector3d& momentum, const auto& at) {
    Eigen::Quaterniond now = q;
    double time = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      now = turned<double>(now, momentum, inertia, times[i] - time);
      time = times[i];
      at(i, now);
    }
  };
  follow(h, [&](std::size_t i, const Eigen::Quaterniond& now) { ends[i].q = now; });
  std::vector<Eigen::Quaterniond> more(times.size());
  for (int axis = 0; axis < 3 && derivatives; ++axis) {
    const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(axis);
    follow(h + d, [&](std::size_t i, const Eigen::Quaterniond& now) { more[i] = now; });
    follow(h - d, [&](std::size_t i, const Eigen::Quaterniond& less) {
      ends[i].along_h.col(axis) = rotation_vector<double>(more[i] * less.conjugate()) / (2.0 * step);
    });
  }
  return ends;
}

}  // namespace unseen::collision
