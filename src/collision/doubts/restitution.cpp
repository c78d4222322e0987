// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/restitution.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {

namespace {

/// Deviation of the weighted mean where parts of the errors are common to all.
double deviation_with(const std::vector<Estimate>& estimates, const std::vector<Vec3>& common, const std::vector<double>& weights) {
  Vec3 shared = Vec3::Zero();
  double own = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < common.size(); ++i) {
    shared += weights[i] * common[i];
    own += std::pow(weights[i], 2) * std::max(0.0, std::pow(estimates[i].sd, 2) - common[i].squaredNorm());
    sum += weights[i];
  }
  return std::sqrt(own + shared.squaredNorm()) / std::max(1e-12, sum);
}

}  // namespace

Estimate pooled(const std::vector<Estimate>& estimates, const std::vector<Vec3>& common) {
  constexpr double kLeast = 1e-3;  // no estimate counts as surer than this
  if (estimates.size() == 1) return estimates.front();
  double weights = 0.0, sum = 0.0, squares = 0.0;
  std::vector<double> each;
  for (const Estimate& e : estimates) {
    const double w = 1.0 / std::max(kLeast * kLeast, e.sd * e.sd);
    each.push_back(w);
    weights += w;
    sum += w * e.value;
  }
  Estimate p;
  p.value = sum / weights;
  for (const Estimate& e : estimates) squares += std::pow(e.value - p.value, 2) / std::max(kLeast * kLeast, e.sd * e.sd);
  const double disagreement = estimates.size() > 1 ? squares / static_cast<double>(estimates.size() - 1) : 0.0;
  p.sd = std::max(std::sqrt(std::max(1.0, disagreement) / weights), deviation_with(estimates, common, each));
  p.low = std::max(0.0, p.value - 1.96 * p.sd);
  p.high = std::min(1.0, p.value + 1.96 * p.sd);
  return p;
}

}  // namespace unseen::collision
