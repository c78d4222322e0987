// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/solve.h"

#include <ceres/cost_function.h>
#include <ceres/solver.h>

#include <array>
#include <cmath>
#include <utility>

#include "collision/solve/setup.h"
#include "collision/solve/touch.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

/// One descent; the contact's features stay as they are.
bool descend(const Problem& problem, const std::optional<Proximity>& touch, int iterations, State& state, double& cost) {
  const State reference = state;
  Setup setup(problem, reference, touch);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-10;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  if (!setup.ceres.Evaluate({}, &cost, nullptr, nullptr, nullptr)) return false;  // Ceres would write to the user's terminal
  ceres::Solver::Summary summary;
  ceres::Solve(options, &setup.ceres, &summary);
  if (!summary.IsSolutionUsable()) return false;
  state = state_at(problem, reference, setup.evaluation.unknowns().data());
  cost = summary.final_cost;
  return true;
}

std::map<std::string, double> term_sizes(const Problem& problem, const Fit& fit) {
  Setup setup(problem, fit.state, fit.touch);
  setup.evaluation.PrepareForEvaluation(false, true);
  std::map<std::string, std::pair<double, int>> sums;
  for (const NamedBlock& block : setup.blocks) {
    std::array<double, 16> residuals = {};
    double cost = 0.0;
    if (!setup.ceres.EvaluateResidualBlockAssumingParametersUnchanged(block.id, false, &cost, residuals.data(), nullptr)) continue;
    auto& [sum, count] = sums[block.term];
    sum += 2.0 * cost;
    count += setup.ceres.GetCostFunctionForResidualBlock(block.id)->num_residuals();
  }
  std::map<std::string, double> sizes;
  for (const auto& [name, sum] : sums) sizes[name] = std::sqrt(sum.first / sum.second);
  return sizes;
}

}  // namespace

Fit approach(const Problem& problem, const State& start) {
  constexpr int kIterations = 40;
  Fit fit;
  fit.state = start;
  fit.state.law.reset();
  const Problem free = without_bounds(problem);  // bounds come last: on the way they would hold a solution back that leads to a better one within them
  if (!problem.terms.soft && !problem.orientations.empty()) {  // momenta on both sides first, then the impulse that joins them
    Problem apart = free;
    apart.terms.soft = true;
    if (!descend(apart, std::nullopt, kIterations, fit.state, fit.cost)) fit.state = start;
  }
  fit.usable = descend(free, std::nullopt, kIterations, fit.state, fit.cost);
  return fit;
}

Fit try_out(const Problem& problem, const State& start) {
  constexpr int kIterations = 12;
  Fit fit;
  fit.state = start;
  fit.touch = touch_of(problem, start);
  fit.state.law = law_of(problem, fit.state, fit.touch);
  fit.usable = descend(without_bounds(problem), fit.touch, kIterations, fit.state, fit.cost);
  fit.state.law.reset();
  return fit;
}

Fit settle(const Problem& problem, const State& start) {
  constexpr int kIterations = 60, kTouches = 6;
  Fit fit;
  fit.state = start;
  for (int i = 0; i < kTouches; ++i) {
    const std::optional<Proximity> before = fit.touch;
    const double cost_before = fit.cost;
    fit.touch = touch_of(problem, fit.state);
    if (fit.touch && !fit.state.law) {
      fit.state.law = law_of(problem, fit.state, fit.touch);
      fit.state.x = contact_start(problem, *fit.touch, fit.state);
      descend(without_bounds(problem), fit.touch, kIterations, fit.state, fit.cost);
    }
    fit.state.law = law_of(problem, fit.state, fit.touch);
    fit.usable = descend(problem, fit.touch, kIterations, fit.state, fit.cost);
    if (!fit.usable || !fit.touch || (before && std::abs(fit.cost - cost_before) < 1e-6 * (1.0 + fit.cost))) break;
  }
  if (fit.usable) fit.terms = term_sizes(problem, fit);
  return fit;
}

}  // namespace unseen::collision
