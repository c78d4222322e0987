// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/common_error.h"

#include <cmath>

#include "unseen/core/quantile.h"

namespace unseen::collision {

constexpr double kUnsure = 0.06;  // deviation of the restitution from which on it is worth another solve

void weigh_common_error(Solution& solution, Uncertain& uncertain, int resamples, int seed, Context& context) {
  if (solution.problem.trends.empty() || !solution.problem.filmed || uncertain.restitution.sd < kUnsure) return;
  Solution other = solution;
  Problem& problem = other.problem;
  std::vector<double> sizes;
  for (const PointObservation& p : problem.points)
    if (p.depth > 0.0) sizes.push_back(problem.camera.fx * problem.solids[static_cast<std::size_t>(p.body)].mass.extent / p.depth);
  const double of_a_flight = 0.5 * static_cast<double>(problem.points.size());
  problem.pixel_sigma = std::hypot(problem.pixel_sigma, kLopsided * median(sizes) * std::sqrt(of_a_flight));
  other.fit = settle(problem, other.fit.state);
  if (!other.fit.usable) return;
  const Uncertain now = uncertainty(other, resamples, seed, context);
  if (now.restitution.sd >= uncertain.restitution.sd) return;
  solution = std::move(other);
  uncertain = now;
}

}  // namespace unseen::collision
