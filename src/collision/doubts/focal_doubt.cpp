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

/// Solutions with focal lengths from two kSigma shorter to two longer, in equal steps about the solution's own. Nothing where none was found.
std::vector<std::optional<Other>> with_other_lengths(const Solution& solution) {
  std::vector<std::optional<Other>> others(2 * kSteps + 1);
  const Fit middle = settle(solution.problem, solution.fit.state);
  if (!middle.usable) return others;
  others[kSteps] = {middle.cost, bounded_restitution(solution.problem, middle.state), middle.state.mass_ratio};
  for (const int way : {1, -1}) {
    const double step = way * 2.0 / kSteps;
    Problem problem = solution.problem;
    Fit fit = middle;
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
  if (others.empty()) return {};
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

double likelier_focal_length(const std::vector<SolvedImpact>& impacts, double so_far, const Context& context) {
  constexpr double kTelling = 10.0;  // −log of a likelihood: less is no reason to leave what is usual. Centroids of a flight are off together
  constexpr double kStands = 0.01;   // of the logarithm
  constexpr std::size_t kAll = 2 * kSteps + 1;
  for (const SolvedImpact& impact : impacts) {
    const Problem& p = impact.solution.problem;
    const bool balls = p.solids[0].is_sphere() && (p.fixed || p.solids[1].is_sphere());
    if (!p.focal_assumed || p.planar || (p.filmed && !balls)) return 1.0;  // the centroids of boxes and meshes need their orientations first
  }
  std::vector<std::vector<std::optional<Other>>> others(impacts.size());
  parallel_blocks(context, impacts.size(), 1, [&](std::size_t i, std::size_t) { others[i] = with_other_lengths(impacts[i].solution); });
  std::vector<double> unlikely(kAll);
  for (std::size_t k = 0; k < kAll; ++k) {
    const double deviations = deviations_of_step(k) + std::log(so_far) / kSigma;
    unlikely[k] = std::abs(deviations) < 2.0 + 0.5 / kSteps ? unusual(deviations) : std::numeric_limits<double>::infinity();
  }
  for (const auto& of_impact : others) {
    if (std::any_of(of_impact.begin(), of_impact.end(), [](const auto& other) { return !other; })) continue;
    for (std::size_t k = 0; k < kAll; ++k) unlikely[k] += of_impact[k]->unlikely;
  }
  const auto best = static_cast<std::size_t>(std::min_element(unlikely.begin(), unlikely.end()) - unlikely.begin());
  if (so_far == 1.0 && !(unlikely[best] < unlikely[kSteps] - kTelling)) return 1.0;
  double step = deviations_of_step(best);
  if (best > 0 && best + 1 < kAll && std::isfinite(unlikely[best - 1] + unlikely[best + 1])) {  // the lowest point of a parabola
    const double bend = unlikely[best - 1] - 2.0 * unlikely[best] + unlikely[best + 1];
    if (bend > 0.0) step -= 0.5 * (unlikely[best + 1] - unlikely[best - 1]) / bend * 2.0 / kSteps;
  }
  return std::abs(kSigma * step) < kStands ? 1.0 : std::exp(kSigma * step);
}

}  // namespace unseen::collision
