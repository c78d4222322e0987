// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/placement_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace unseen::interactions {
namespace {

/// Of a cost of (cos θ, sin θ) alone, a₀ + a₁cos θ + a₂ sin θ + a₃ cos 2θ + a₄ sin 2θ: the angle where it is least.
double best_angle(const Eigen::Matrix2d& quadratic, const Vec2& linear) {
  const double c1 = 2 * linear.x(), s1 = 2 * linear.y();
  const double c2 = 0.5 * (quadratic(0, 0) - quadratic(1, 1)), s2 = quadratic(0, 1);
  const auto value = [&](double t) { return c1 * std::cos(t) + s1 * std::sin(t) + c2 * std::cos(2 * t) + s2 * std::sin(2 * t); };
  constexpr int kSamples = 16;  // it has at most two valleys, and they may be nearly as deep
  std::array<double, kSamples> values;
  for (int i = 0; i < kSamples; ++i) values[i] = value(2 * kPi * i / kSamples);
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSamples; ++i) {
    if (values[i] > values[(i + 1) % kSamples] || values[i] > values[(i + kSamples - 1) % kSamples]) continue;
    double angle = 2 * kPi * i / kSamples;
    for (int round = 0; round < 6; ++round) {
      const double slope = -c1 * std::sin(angle) + s1 * std::cos(angle) - 2 * c2 * std::sin(2 * angle) + 2 * s2 * std::cos(2 * angle);
      const double bend = -c1 * std::cos(angle) - s1 * std::sin(angle) - 4 * c2 * std::cos(2 * angle) - 4 * s2 * std::sin(2 * angle);
      angle -= std::clamp(slope / std::max(std::abs(bend), 1e-12), -kPi / kSamples, kPi / kSamples);
    }
    if (const double v = value(angle); v < least) {
      least = v;
      best = angle;
    }
  }
  return best;
}

}  // namespace

void PlacementCost::add(const Vec3& p, const Vec3& center, const Mat3& information) {
  Eigen::Matrix<double, 3, 4> jacobian;  // of p placed, minus the centre
  jacobian << p.x(), -p.y(), 1, 0,  //
      p.y(), p.x(), 0, 1,           //
      0, 0, 0, 0;
  const Vec3 rest(-center.x(), -center.y(), p.z() - center.z());
  quadratic += jacobian.transpose() * information * jacobian;
  linear += jacobian.transpose() * information * rest;
  constant += rest.dot(information * rest);
}

double PlacementCost::at(double angle, const Vec2& position) const {
  const Eigen::Vector4d q(std::cos(angle), std::sin(angle), position.x(), position.y());
  return q.dot(quadratic * q) + 2 * linear.dot(q) + constant;
}

bool fit_placement(const PlacementCost& cost, PlacementFit& best) {
  const Eigen::Matrix2d position = cost.quadratic.bottomRightCorner<2, 2>();
  if (!(position.determinant() > 1e-9 * position.trace() * position.trace())) return false;
  const Eigen::Matrix2d inverse = position.inverse();
  const Eigen::Matrix2d mixed = cost.quadratic.bottomLeftCorner<2, 2>();
  const Vec2 linear = cost.linear.tail<2>();
  const Eigen::Matrix2d reduced = cost.quadratic.topLeftCorner<2, 2>() - mixed.transpose() * inverse * mixed;
  const Vec2 reduced_linear = cost.linear.head<2>() - mixed.transpose() * inverse * linear;
  best.angle = best_angle(reduced, reduced_linear);
  const Vec2 turn(std::cos(best.angle), std::sin(best.angle));
  best.position = -inverse * (mixed * turn + linear);
  best.cost = std::max(0.0, cost.at(best.angle, best.position));
  return true;
}

}  // namespace unseen::interactions
