// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/normal_doubts.h"

#include <ceres/jet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/solve/unknowns.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr double kStops = 0.4;       // of a hollow ball's speed: the most that friction takes from one that does not spin
constexpr double kUsualFriction = 0.3;  // coefficient
constexpr double kSpinUnlikely = 0.8;   // χ²: two fifths of what is thrown are taken to spin
constexpr double kLever = 0.25;         // of a body's extent: how far off its centre a usual hit is
constexpr double kLeast = 0.08;      // rad: a smaller tilt moves the restitution by a hundredth or less
constexpr double kOtherValue = 0.01;   // of the restitution
constexpr double kUnlikely = 13.8;   // χ² of two numbers that chance exceeds once in a thousand

/// Σ^(−1/2) or Σ^(−1) of a covariance without full rank.
Mat3 power_of(const Mat3& covariance, double exponent) {
  const SymmetricEigen<3> eigen = symmetric_eigen(covariance);
  Vec3 powers = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (eigen.values[i] > 1e-9 * eigen.values[2]) powers[i] = std::pow(eigen.values[i], exponent);
  return eigen.vectors * powers.asDiagonal() * eigen.vectors.transpose();
}

/// What of the impulse along a level floor no friction explains, over the impulse along its normal; with derivatives.
Vec3T<Wide> unexplained(const StateT<Wide>& s) {
  const Vec3T<Wide> n = -s.down, along = s.impulse - n * s.impulse.dot(n), sliding = s.v[0] - n * s.v[0].dot(n);
  const Wide speed = sliding.squaredNorm();
  const double slowed = speed.a > 1e-9 ? std::clamp(-along.dot(sliding).a / speed.a, 0.0, kStops) : 0.0;
  return (along + sliding * Wide(slowed)) / s.impulse.dot(n);
}

}  // namespace

void doubt_level(Solution& solution) {
  const Problem& problem = solution.problem;
  const Fit& fit = solution.fit;
  if (!problem.level || !problem.friction || !problem.solids[0].is_sphere() || problem.turns(0) || fit.covariance.size() == 0) return;
  const StateT<Wide> s = wide_values_of(problem, fit.state);
  const Vec3T<Wide> off = unexplained(s);
  const Vec3 lean(off[0].a, off[1].a, off[2].a);
  Eigen::Matrix<double, 3, kUnknowns> slopes;
  for (int i = 0; i < 3; ++i) slopes.row(i) = off[i].v.transpose();
  const Mat3 covariance = slopes * fit.covariance * slopes.transpose();
  if (lean.norm() < kLeast || lean.dot(power_of(covariance, -1.0) * lean) < kUnlikely) return;
  State tilted = fit.state;
  tilted.law.reset();
  tilted.x = tilted.p[0] - problem.solids[0].radius * tilted.impulse.normalized();
  const double c = bounded_restitution(problem, tilted);
  const double tilt = degrees(line_angle(fit.state.impulse, fit.state.down));
  solution.others.push_back({fmt::format("a floor that is tilted by {:.0f}°, where a level one needs a ball that spins: c = {:.2f}", tilt, c), c, fit.state.mass_ratio, 0.0});
}

void doubt_normal(Solution& solution) {
  const Problem& problem = solution.problem;
  const State& state = solution.fit.state;
  if (!problem.friction || problem.fixed_normal || !problem.is_of_centres()) return;
  const StateT<double> s = values_of(problem, state);
  const auto meeting = [&](bool after) -> Vec3 { return contact_velocity<double>(problem, s, 0, after) - contact_velocity<double>(problem, s, 1, after); };
  const Vec3 before = meeting(false), after = meeting(true), along = (after - before).normalized();
  const Vec3 sliding = before - along * before.dot(along);
  const double speed = sliding.norm(), change = (after - before).norm();
  if (change < 1e-9 || speed < 1e-9) return;
  const auto add = [&](double friction, const char* of, double excess) {
    const Vec3 normal = (along + friction * sliding / speed).normalized();
    const double c = std::clamp(-after.dot(normal) / std::min(-1e-6, before.dot(normal)), 0.0, 1.0);
    solution.others.push_back({fmt::format("{} with a friction of {:.2f}: c = {:.2f}", of, friction, c), c, state.mass_ratio, excess});
  };
  const double without_spin = std::min(kUsualFriction, kStops * speed / change);
  add(without_spin, "a contact", 0.0);
  if (without_spin < kUsualFriction) add(kUsualFriction, "a contact of what spins,", kSpinUnlikely);
}

void doubt_lever(Solution& solution) {
  const Problem& problem = solution.problem;
  const State& state = solution.fit.state;
  if (!problem.is_of_centres()) return;
  double straight = 0.0, spinning = 0.0;  // inverse masses, as the impulse feels them
  for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
    const Solid& solid = problem.solids[o];
    const double inverse = o == 0 ? 1.0 : 1.0 / state.mass_ratio;
    straight += inverse;
    spinning += inverse * (solid.is_sphere() ? 1.0 : 1.0 + std::pow(kLever * solid.mass.extent, 2) / solid.mass.inertia.mean());
  }
  const double central = bounded_restitution(problem, state);
  const double c = std::min(1.0, (1.0 + central) * spinning / straight - 1.0);
  if (c - central > kOtherValue)
    solution.others.push_back({fmt::format("a hit off the centre, from which bodies spin: c = {:.2f}", c), c, state.mass_ratio, 0.0});
}

Vec3 error_by_vertical(const Problem& problem, const Fit& fit) {
  if (problem.gravity == 0.0 || fit.covariance.size() == 0) return Vec3::Zero();
  const StateT<Wide> s = wide_values_of(problem, fit.state);
  const Wide c = restitution<Wide>(problem, fit.state, s);
  Eigen::Matrix<double, 3, kUnknowns> slopes;
  for (int i = 0; i < 3; ++i) slopes.row(i) = s.down[i].v.transpose();
  const Vec3 shared = slopes * fit.covariance * c.v;
  const Mat3 covariance = slopes * fit.covariance * slopes.transpose();
  if (covariance.trace() < 1e-16) return Vec3::Zero();
  return power_of(covariance, -0.5) * shared;
}

}  // namespace unseen::collision
