// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/rotation.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

using Eigen::Quaterniond, Eigen::Vector3d;

/// The rotation by less than a radian or so, without sines: the next terms are below 1e-10.
Quaterniond small_rotation(const Vector3d& r) {
  const double s = 0.25 * r.squaredNorm();
  if (s > 0.1) return rotation_by<double>(r);
  const double sine = 0.5 * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0)))));
  const double cosine = 1.0 + s * (-1.0 / 2.0 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40320.0 - s * (1.0 / 3628800.0)))));
  return {cosine, sine * r.x(), sine * r.y(), sine * r.z()};
}

int steps_of(const Vector3d& h, const Vector3d& inertia, double dt) {
  constexpr double kTurn = 0.4;         // rad
  constexpr double kMostSteps = 150.0;  // 60 rad: faster bodies are beyond what a video shows
  return static_cast<int>(std::min(kMostSteps, std::max(1.0, std::ceil(h.norm() / inertia.minCoeff() * std::abs(dt) / kTurn))));
}

Quaterniond turned_in(int steps, const Quaterniond& q, const Vector3d& h, const Vector3d& inertia, double dt) {
  if (inertia.maxCoeff() - inertia.minCoeff() <= 1e-12 * inertia.maxCoeff()) return rotation_by<double>(h * (dt / inertia.x())) * q;
  const Vector3d rate = dt / steps * inertia.cwiseInverse();
  Quaterniond now = q;
  Vector3d inner = q.conjugate() * h;  // the momentum, on the axes that the body has at each step
  for (int i = 0; i < steps; ++i) {
    // derivatives of the momentum, of which Euler's equations make the next, and of the angular velocity; times the step's powers
    const Vector3d w = rate.cwiseProduct(inner), h1 = inner.cross(w), w1 = rate.cwiseProduct(h1);
    const Vector3d h2 = h1.cross(w) + inner.cross(w1), w2 = rate.cwiseProduct(h2);
    const Vector3d w3 = rate.cwiseProduct(h2.cross(w) + 2.0 * h1.cross(w1) + inner.cross(w2));
    const Quaterniond turn = small_rotation(w + w1 / 2.0 + w2 / 6.0 + w3 / 24.0 + w.cross(w1 / 12.0 + w2 / 24.0));
    now = now * turn;
    inner = turn.conjugate() * inner;
  }
  return now.normalized();
}

}  // namespace

Quaterniond turned(const Quaterniond& q, const Vector3d& h, const Vector3d& inertia, double dt) {
  return turned_in(steps_of(h, inertia, dt), q, h, inertia, dt);
}

std::vector<TurnedEnd> turned_through(const Quaterniond& q, const Vector3d& h, const Vector3d& inertia, const std::vector<double>& times, bool derivatives) {
  // differences of what is stepped alike, which is faster than carrying derivatives through the steps
  const double step = 1e-6 * (h.norm() + 1e-3 * inertia.maxCoeff());
  std::vector<TurnedEnd> ends(times.size());
  const auto follow = [&](const Vector3d& momentum, const auto& at) {
    Quaterniond now = q;
    double time = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      now = turned_in(steps_of(h, inertia, times[i] - time), now, momentum, inertia, times[i] - time);
      time = times[i];
      at(i, now);
    }
  };
  follow(h, [&](std::size_t i, const Quaterniond& now) { ends[i].q = now; });
  for (int axis = 0; axis < 3 && derivatives; ++axis)
    follow(h + step * Vector3d::Unit(axis), [&](std::size_t i, const Quaterniond& now) {
      ends[i].along_h.col(axis) = rotation_vector<double>(now * ends[i].q.conjugate()) / step;
    });
  return ends;
}

}  // namespace unseen::collision
