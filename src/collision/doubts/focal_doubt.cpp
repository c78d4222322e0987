// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/focal_doubt.h"

#include <algorithm>
#include <cmath>

#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kSigma = 0.3;  // of the logarithm of an assumed focal length: two of these reach from 35° to 93° for an assumed 60°
constexpr int kSteps = 4;       // each way, over two of these

/// A solution with another focal length.
struct Other {
  double unlikely, restitution, mass_ratio;  // the first: −log of its likelihood and of the focal length's
};

void stretch(Problem& problem, double factor) {
  problem.camera.fx *= factor;
  problem.camera.fy *= factor;
  for (PointObservation& p : problem.points) p.depth *= factor;
}

/// Gravity tells the scale: the longer the focal length, the farther away and the deeper is the scene.
void stretch(State& state, double factor) {
  for (Vec3* v : {&state.p[0], &state.p[1], &state.v[0], &state.v[1], &state.v_after[0], &state.v_after[1], &state.x, &state.impulse}) v->z() *= factor;
}

}  // namespace

FocalError error_by_focal_length(const Solution& solution) {
  if (!solution.problem.focal_assumed || solution.problem.planar) return {};
  const double c = bounded_restitution(solution.problem, solution.fit.state), m = solution.fit.state.mass_ratio;
  std::vector<Other> others = {{solution.fit.cost, c, m}};
  for (const double step : {2.0 / kSteps, -2.0 / kSteps}) {
    Problem problem = solution.problem;
    Fit fit = solution.fit;
    for (int i = 1; i <= kSteps && fit.usable; ++i) {
      stretch(problem, std::exp(kSigma * step));
      stretch(fit.state, std::exp(kSigma * step));
      fit = settle(problem, fit.state);
      if (fit.usable) others.push_back({fit.cost + 0.5 * step * step * i * i, bounded_restitution(problem, fit.state), fit.state.mass_ratio});
    }
  }
  const auto less = [](const Other& a, const Other& b) { return a.unlikely < b.unlikely; };
  const double least = std::min_element(others.begin(), others.end(), less)->unlikely;
  double sum = 0.0;
  FocalError squared;
  for (const Other& other : others) {
    const double weight = std::exp(least - other.unlikely);
    sum += weight;
    squared.restitution += weight * std::pow(other.restitution - c, 2);
    squared.mass_ratio += weight * std::pow(other.mass_ratio - m, 2);
  }
  return {std::sqrt(squared.restitution / sum), std::sqrt(squared.mass_ratio / sum)};
}

}  // namespace unseen::collision
