// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/rotation.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

/// The rotation by a vector, applied to vectors.
struct Turn {
  explicit Turn(const Eigen::Vector3d& by) : r(by) {
    const double s = r.squaredNorm();
    if (s < 0.25) {  // the next terms of the series are below 1e-10
      sine = 1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0))));
      versine = 0.5 + s * (-1.0 / 24.0 + s * (1.0 / 720.0 + s * (-1.0 / 40320.0 + s * (1.0 / 3628800.0))));
    } else {
      sine = std::sin(std::sqrt(s)) / std::sqrt(s);
      versine = (1.0 - std::cos(std::sqrt(s))) / s;
    }
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d across = r.cross(v);
    return v + sine * across + versine * r.cross(across);
  }
  Eigen::Vector3d back(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d across = r.cross(v);
    return v - sine * across + versine * r.cross(across);
  }

  Eigen::Vector3d r;
  double sine, versine;
};

}  // namespace

Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& h, const Eigen::Vector3d& inertia, double dt) {
  constexpr double kTurn = 0.3;
  constexpr int kMostSteps = 150;  // 45 rad: faster bodies are beyond what a video shows
  if (inertia.maxCoeff() - inertia.minCoeff() <= 1e-12 * inertia.maxCoeff()) return rotation_by<double>(h * (dt / inertia.x())) * q;
  const int steps = std::clamp(static_cast<int>(std::ceil(h.norm() / inertia.minCoeff() * std::abs(dt) / kTurn)), 1, kMostSteps);
  const Eigen::Vector3d rate = dt / steps * inertia.cwiseInverse();
  Eigen::Quaterniond now = q;
  Eigen::Vector3d inner = q.conjugate() * h;  // the momentum, on the axes that the body has at each step
  const auto turning = [&](const Eigen::Vector3d& by) -> Eigen::Vector3d {
    const Turn turn(by);
    return turn * rate.cwiseProduct(turn.back(inner));
  };
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d k1 = rate.cwiseProduct(inner), k2 = turning(0.5 * k1), k3 = turning(0.5 * k2 - 0.125 * k1.cross(k2)), k4 = turning(k3);
    const Eigen::Vector3d turn = (k1 + 2.0 * k2 + 2.0 * k3 + k4 - 0.5 * k1.cross(k4)) / 6.0;
    now = now * rotation_by<double>(turn);
    inner = Turn(turn).back(inner);
  }
  return now.normalized();
}

std::vector<TurnedEnd> turned_through(const Eigen::Quaterniond& q, const Eigen::Vector3d& h, const Eigen::Vector3d& inertia,
                                      const std::vector<double>& times, bool derivatives) {
  // central differences: of fourth-order steps in plain numbers, faster than carrying derivatives through them
  const double step = 1e-4 * (h.norm() + 1e-3 * inertia.maxCoeff());
  std::vector<TurnedEnd> ends(times.size());
  const auto follow = [&](const Eigen::Vector3d& momentum, const auto& at) {
    Eigen::Quaterniond now = q;
    double time = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      now = turned(now, momentum, inertia, times[i] - time);
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
