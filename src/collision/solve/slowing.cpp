// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/slowing.h"

#include <algorithm>
#include <array>
#include <limits>

#include "collision/solve/shared_value.h"
#include "collision/solve/solve.h"

namespace unseen::collision {
namespace {

constexpr double kMost = 3.0;  // m/s²: a friction of 0.3

SolvedWith any_slowing(const std::vector<SolvedImpact>& impacts) {
  return [&](double slowing) { return with_slowing(impacts, slowing); };
}

/// What regions that are lopsided, by half of what they may be, bend the longest flight by, m/s².
double bend_of_lopsided(const Problem& problem) {
  if (!problem.filmed) return 0.0;
  std::array<std::array<double, 2>, 4> ends;  // of the two bodies' flights before and after, s
  ends.fill({std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  for (const PointObservation& p : problem.points) {
    auto& [first, last] = ends[static_cast<std::size_t>(2 * p.body + p.after)];
    first = std::min(first, p.time), last = std::max(last, p.time);
  }
  double least = kMost;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double length = ends[k][1] - ends[k][0];
    if (length > 0.0) least = std::min(least, 8.0 * 0.5 * kLopsided * problem.solids[k / 2].mass.extent / (length * length));  // the sagitta of a parabola is 1/8 of that
  }
  return least;
}

}  // namespace

std::vector<SolvedImpact> with_slowing(std::vector<SolvedImpact> impacts, double slowing) {
  for (SolvedImpact& impact : impacts) {
    impact.solution.problem.slowing = slowing;
    impact.solution.fit = settle(impact.solution.problem, impact.solution.fit.state);
  }
  return impacts;
}

double best_slowing(const std::vector<SolvedImpact>& impacts) { return likeliest_value(any_slowing(impacts), kMost); }

void add_doubt_of_slowing(const std::vector<SolvedImpact>& impacts, Reconstruction& result) {
  constexpr double kLeastStep = 0.01, kStep = 0.2;  // m/s², and of the slowing
  const Problem& problem = impacts.front().solution.problem;
  if (problem.planar) add_doubt(any_slowing(impacts), {problem.slowing, kMost, kLeastStep + kStep * problem.slowing, bend_of_lopsided(problem)}, impacts, result);
}

}  // namespace unseen::collision
