// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/alternative.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/restitution.h"
#include "collision/shot_problem.h"
#include "collision/solve/estimates.h"

namespace unseen::collision {
namespace {

constexpr double kClearlyBetter = 9.0;  // χ²
constexpr double kHardlyWorse = 4.0;    // χ²
constexpr double kSlack = 0.05;         // outside of [0, 1]: no body bounces so

void widen(Estimate& estimate, double value) {
  const double half = 1.96 * estimate.sd;
  estimate.low = std::clamp(std::min(estimate.low, value - half), 0.0, 1.0);
  estimate.high = std::clamp(std::max(estimate.high, value + half), 0.0, 1.0);
  estimate.sd = std::hypot(estimate.sd, value - estimate.value);
}

}  // namespace

std::vector<Estimate> restitutions_of(std::vector<SolvedImpact> impacts) {
  std::vector<Estimate> each;
  for (SolvedImpact& impact : impacts) {
    add_covariance(impact.solution.problem, impact.solution.fit);
    each.push_back(restitution_of(impact.solution.problem, impact.solution.fit));
  }
  return each;
}

void widen_to_hold(const std::vector<SolvedImpact>& solved, Reconstruction& result) {
  const std::vector<Estimate> each = restitutions_of(solved);
  for (std::size_t k = 0; k < solved.size(); ++k) widen(result.impacts[k].restitution, each[k].value);
  if (result.restitution) widen(*result.restitution, std::clamp(pooled(each).value, 0.0, 1.0));
}

void add_alternative(const std::string& what, const std::vector<SolvedImpact>& solved, double saved, Reconstruction& result) {
  const double pool = pooled(restitutions_of(solved)).value, c = std::clamp(pool, 0.0, 1.0);
  if (!(std::abs(pool - c) < kSlack)) return;
  const bool outside = !result.restitution || c < result.restitution->low || c > result.restitution->high;
  widen_to_hold(solved, result);
  if (!(saved > kClearlyBetter || (outside && saved > -kHardlyWorse))) return;
  const double mass_ratio = solved.front().solution.problem.fixed ? 0.0 : solved.front().solution.fit.state.mass_ratio;
  result.ambiguous.push_back({fmt::format("{}: c = {:.2f}", what, c), c, mass_ratio, -saved});
}

}  // namespace unseen::collision
