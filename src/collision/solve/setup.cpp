// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kMostRatio = 1000.0;  // of masses: beyond, the heavier body might as well be fixed

/// The unknowns but those that nothing in the shot tells of, or that are given.
std::vector<int> free_unknowns(const Problem& problem) {
  std::array<bool, kUnknowns> held = {};
  const auto hold = [&](int from, int count) { std::fill_n(held.begin() + from, count, true); };
  if (problem.gravity == 0.0) hold(kDown, 2);
  if (problem.fixed || problem.mass_ratio) hold(kLogMass, 1);
  for (int o = 0; o < 2; ++o) {
    const bool still = o == 1 && problem.fixed;
    if (still) hold(kP + 3 * o, 3), hold(kV + 3 * o, 3);
    if (!problem.flies(o, false)) hold(kV + 3 * o, 3);
    if (still || !problem.turns(o)) hold(kTurn + 3 * o, 3), hold(kH + 3 * o, 3);
    if (!problem.terms.soft || still) hold(kVAfter + 3 * o, 3);
    if (!problem.terms.soft || still || !problem.turns(o)) hold(kHAfter + 3 * o, 3);
  }
  if (problem.is_of_centres()) hold(kX, 3);
  std::vector<int> free;
  for (int i = 0; i < kUnknowns; ++i)
    if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
  return free;
}

/// The impact lies between the last sighting before it and the first after, or not far from there.
std::pair<double, double> impact_times(const Problem& problem) {
  double last = -1e9, first = 1e9, begin = 1e9, end = -1e9;
  for (const PointObservation& p : problem.points) {
    (p.after ? first : last) = p.after ? std::min(first, p.time) : std::max(last, p.time);
    begin = std::min(begin, p.time);
    end = std::max(end, p.time);
  }
  const double margin = 0.05 * (end - begin);
  return {std::min(last, first) - margin, std::max(last, first) + margin};
}

ceres::Problem::Options options_of(EvaluatedState& evaluation) {
  ceres::Problem::Options options;
  options.evaluation_callback = &evaluation;
  return options;
}

/// An unknown's step stays between the two, and may be none.
void bound(Setup& setup, int unknown, double low, double high) {
  const std::vector<int>& free = setup.evaluation.free;
  const auto at = std::find(free.begin(), free.end(), unknown);
  if (at == free.end()) return;
  const int i = static_cast<int>(at - free.begin());
  setup.ceres.SetParameterLowerBound(setup.steps(), i, std::min(0.0, low));
  setup.ceres.SetParameterUpperBound(setup.steps(), i, std::max(0.0, high));
}

}  // namespace

Setup::Setup(const Problem& problem, const State& reference, const std::optional<Proximity>& touch)
    : evaluation(problem, reference, free_unknowns(problem)), ceres(options_of(evaluation)), blocks(add_residuals(touch, evaluation, ceres)) {
  const auto [earliest, latest] = impact_times(problem);
  bound(*this, kTime, earliest - reference.time, latest - reference.time);
  bound(*this, kLogMass, std::log(1.0 / kMostRatio / reference.mass_ratio), std::log(kMostRatio / reference.mass_ratio));
}

Problem without_bounds(Problem problem) {
  problem.terms.energy = problem.terms.restitution = false;
  return problem;
}

}  // namespace unseen::collision
