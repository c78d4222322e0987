// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/focal_doubt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kSigma = 0.3;  // of the logarithm of an assumed focal length: two of these reach from 35° to 93° for an assumed 60°
constexpr int kSteps = 4;       // each way, over two of these

/// A solution with another focal length.
struct Other {
  double unlikely, restitution, mass_ratio;  // the first: −log of its likelihood
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

/// −log of how usual a focal length is that is `deviations` of kSigma off.
double unusual(double deviations) { return 0.5 * deviations * deviations; }

double deviations_of_step(std::size_t i) { return 2.0 / kSteps * (static_cast<double>(i) - kSteps); }

/// Solutions with focal lengths from two kSigma shorter to two longer, in equal steps; the middle one is the solution itself. Nothing where none was found.
std::vector<std::optional<Other>> with_other_lengths(const Solution& solution) {
  std::vector<std::optional<Other>> others(2 * kSteps + 1);
  others[kSteps] = {solution.fit.cost, bounded_restitution(solution.problem, solution.fit.state), solution.fit.state.mass_ratio};
  for (const int way : {1, -1}) {
    const double step = way * 2.0 / kSteps;
    Problem problem = solution.problem;
    Fit fit = solution.fit;
    for (int i = 1; i <= kSteps && fit.usable; ++i) {
      stretch(problem, std::exp(kSigma * step));
      stretch(fit.state, std::exp(kSigma * step));
      fit = settle(problem, fit.state);
      if (fit.usable) others[kSteps + way * i] = {fit.cost, bounded_restitution(problem, fit.state), fit.state.mass_ratio};
    }
  }
  return others;
}

}  // namespace

FocalError error_by_focal_length(const Solution& solution) {
  if (!solution.problem.focal_assumed || solution.problem.planar) return {};
  const double c = bounded_restitution(solution.problem, solution.fit.state), m = solution.fit.state.mass_ratio;
  std::vector<Other> others;
  const std::vector<std::optional<Other>> all = with_other_lengths(solution);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i]) others.push_back({all[i]->unlikely + unusual(deviations_of_step(i)), all[i]->restitution, all[i]->mass_ratio});
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

double likeliest_focal_length(const std::vector<const Solution*>& solutions, double so_far) {
  constexpr double kTelling = 4.0, kBetter = 0.5;  // −log of a likelihood: less is no reason to leave what is usual; to go on from there
  std::vector<double> unlikely(2 * kSteps + 1);
  for (std::size_t i = 0; i < unlikely.size(); ++i) unlikely[i] = unusual(deviations_of_step(i) + std::log(so_far) / kSigma);
  for (const Solution* solution : solutions) {
    if (!solution->problem.focal_assumed || solution->problem.planar) return 1.0;
    const std::vector<std::optional<Other>> others = with_other_lengths(*solution);
    for (std::size_t i = 0; i < others.size(); ++i) unlikely[i] += others[i] ? others[i]->unlikely : std::numeric_limits<double>::infinity();
  }
  const auto best = static_cast<std::size_t>(std::min_element(unlikely.begin(), unlikely.end()) - unlikely.begin());
  double at = static_cast<double>(best) - kSteps, least = unlikely[best];
  if (best > 0 && best + 1 < unlikely.size() && std::isfinite(unlikely[best - 1] + unlikely[best + 1])) {  // the lowest point of a parabola
    const double slope = 0.5 * (unlikely[best + 1] - unlikely[best - 1]), bend = unlikely[best - 1] - 2.0 * unlikely[best] + unlikely[best + 1];
    if (bend > 0.0) at -= slope / bend, least -= 0.5 * slope * slope / bend;
  }
  if (!(least < unlikely[kSteps] - (so_far == 1.0 ? kTelling : kBetter))) return 1.0;
  return std::exp(kSigma * 2.0 / kSteps * at);
}

}  // namespace unseen::collision
