// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/shared_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/doubts/alternative.h"
#include "collision/doubts/restitution.h"

namespace unseen::collision {

double cost_of(const std::vector<SolvedImpact>& impacts) {
  double cost = 0.0;
  for (const SolvedImpact& impact : impacts) cost += impact.solution.fit.usable ? impact.solution.fit.cost : std::numeric_limits<double>::infinity();
  return cost;
}

double likeliest_value(const SolvedWith& with, double low, double high) {
  constexpr int kRounds = 20;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto cost = [&](double value) { return cost_of(with(value)); };
  double a = high - ratio * (high - low), b = low + ratio * (high - low), cost_a = cost(a), cost_b = cost(b);
  for (int i = 0; i < kRounds; ++i) {
    if (!(cost_b < cost_a)) {
      high = b, b = a, cost_b = cost_a;
      cost_a = cost(a = high - ratio * (high - low));
    } else {
      low = a, a = b, cost_a = cost_b;
      cost_b = cost(b = low + ratio * (high - low));
    }
  }
  return 0.5 * (low + high);
}

void add_doubt(const SolvedWith& with, const FittedValue& fitted, const std::vector<SolvedImpact>& impacts, Reconstruction& result) {
  const double step = fitted.step, middle = std::max(fitted.value, step);
  const std::vector<SolvedImpact> less = with(middle - step), more = with(middle + step);
  const double bend = (cost_of(more) - 2.0 * cost_of(with(middle)) + cost_of(less)) / (step * step);  // of ½ χ²
  if (!std::isfinite(bend)) return;
  const double sd = std::hypot(bend > 0.0 ? 1.0 / std::sqrt(bend) : fitted.most, fitted.systematic);
  const auto inflate = [&](Estimate& estimate, double from, double to, double highest) {
    if (!(estimate.sd > 0.0)) return;
    const double factor = std::hypot(1.0, sd * (to - from) / (2.0 * step) / estimate.sd);
    estimate.low = std::max(0.0, estimate.value - factor * (estimate.value - estimate.low));
    estimate.high = std::min(highest, estimate.value + factor * (estimate.high - estimate.value));
    estimate.sd *= factor;
  };
  const std::vector<Estimate> with_less = restitutions_of(less), with_more = restitutions_of(more);
  for (std::size_t k = 0; k < impacts.size(); ++k) inflate(result.impacts[k].restitution, with_less[k].value, with_more[k].value, 1.0);
  if (result.restitution) inflate(*result.restitution, pooled(with_less).value, pooled(with_more).value, 1.0);
  if (result.mass_ratio) inflate(*result.mass_ratio, less.front().solution.fit.state.mass_ratio, more.front().solution.fit.state.mass_ratio, std::numeric_limits<double>::infinity());
}

}  // namespace unseen::collision
