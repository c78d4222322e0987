// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "collision/orientations/silhouette_fit.h"
#include "collision/solve/rotation.h"
#include "core/linear.h"

namespace unseen::collision {

std::vector<Quat> orientations_of(const Turning& turning, const SpinBody& body, const std::vector<Look>& looks) {
  const Camera any;  // a path needs none
  return SilhouetteFit(body, any, looks, 0, looks.size()).path(turning);
}

Turning at_time(const Turning& turning, const SpinBody& body, double time) {
  Turning other = turning;
  other.q = turned(turning.q, turning.h, body.solid.mass.inertia, time - turning.time);
  other.time = time;
  return other;
}

double silhouette_cost(const Turning& turning, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks,
                       std::size_t begin, std::size_t end) {
  return SilhouetteFit::cost(SilhouetteFit(body, camera, looks, begin, end).residuals(turning));
}

Turning refined(const Turning& start, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin,
                std::size_t end, int steps) {
  constexpr double kFarthest = 0.4;
  const SilhouetteFit fit(body, camera, looks, begin, end);
  Turning best = at_time(start, body, fit.middle());
  SilhouetteFit::Residuals r = fit.residuals(best);
  best.cost = SilhouetteFit::cost(r);
  double damping = 1e-3;
  SilhouetteFit::Matrix6 normal;
  SilhouetteFit::Vector6 gradient;
  fit.linearise(best, r, normal, gradient);
  for (int step = 0; step < steps && damping < 1e4; ++step) {
    SilhouetteFit::Matrix6 damped = normal;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-6;
    SilhouetteFit::Vector6 move = -solve_symmetric(damped, gradient);
    if (move.norm() > kFarthest) move *= kFarthest / move.norm();
    Turning next = fit.moved(best, move);
    const SilhouetteFit::Residuals there = fit.residuals(next);
    next.cost = SilhouetteFit::cost(there);
    if (next.cost < best.cost) {
      const bool done = best.cost - next.cost < 1e-3;
      best = next, r = there, damping *= 0.2;
      fit.linearise(best, r, normal, gradient);
      if (done) break;
    } else {
      damping = std::max(10.0 * damping, 1e-2);
    }
  }
  SilhouetteFit::Vector6 unit;
  unit << 1, 1, 1, Vec3::Constant(1.0 / fit.momentum_unit());
  best.information = unit.asDiagonal() * normal * unit.asDiagonal();
  return best;
}

}  // namespace unseen::collision
