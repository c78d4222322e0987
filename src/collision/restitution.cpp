// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/restitution.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {

Estimate pooled(const std::vector<Estimate>& estimates) {
  constexpr double kLeast = 1e-3;  // no estimate counts as surer than this
  if (estimates.size() == 1) return estimates.front();
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (const Estimate& e : estimates) {
    const double w = 1.0 / std::max(kLeast * kLeast, e.sd * e.sd);
    weights += w;
    sum += w * e.value;
  }
  Estimate p;
  p.value = sum / weights;
  for (const Estimate& e : estimates) squares += std::pow(e.value - p.value, 2) / std::max(kLeast * kLeast, e.sd * e.sd);
  const double disagreement = estimates.size() > 1 ? squares / static_cast<double>(estimates.size() - 1) : 0.0;
  p.sd = std::sqrt(std::max(1.0, disagreement) / weights);
  p.low = std::max(0.0, p.value - 1.96 * p.sd);
  p.high = std::min(1.0, p.value + 1.96 * p.sd);
  return p;
}

}  // namespace unseen::collision
