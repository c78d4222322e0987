// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/scale_doubt.h"

#include <algorithm>
#include <cmath>

#include "collision/solve/estimates.h"
#include "collision/solve/unknowns.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kScale = 0.05;       // share by which size and gravity may differ
constexpr double kOtherSize = 0.08;   // share by which the sizes of two bodies fit better if these are exchanged
constexpr double kOtherScale = 0.15;  // the same for bodies whose projected size depends on how they are turned

std::optional<double> scale_ratio(const Solution& solution, int body) {
  Problem problem = solution.problem;
  problem.terms.size = false;
  if (problem.gravity == 0.0) return std::nullopt;
  Fit fit = settle(problem, solution.fit.state);
  if (!fit.usable) return std::nullopt;
  add_covariance(problem, fit);
  const double depth = fit.state.p[body].z(), deviation = std::sqrt(std::max(0.0, fit.covariance(kP + 3 * body + 2, kP + 3 * body + 2)));
  if (!(deviation < 0.5 * kScale * depth)) return std::nullopt;
  std::vector<double> ratios;
  const StateT<double> s = values_of(problem, fit.state);
  for (const PointObservation& seen : problem.points)
    if (seen.body == body && seen.depth > 0.0) ratios.push_back(seen.depth / position_at<double>(problem, s, body, seen.after, seen.time).z());
  if (ratios.size() < 5) return std::nullopt;
  return median(std::move(ratios));
}

}  // namespace

ScaleRatios scale_ratios(const Solution& solution) {
  return {scale_ratio(solution, 0), solution.problem.fixed ? std::nullopt : scale_ratio(solution, 1)};
}

bool is_another_scale(const Solid& solid, double ratio) { return std::abs(ratio - 1.0) > (solid.is_sphere() ? kScale : kOtherScale); }

bool look_exchanged(const Solution& solution) {
  const auto& solids = solution.problem.solids;
  if (solution.problem.fixed || !solids[0].is_sphere() || !solids[1].is_sphere()) return false;
  const ScaleRatios ratios = scale_ratios(solution);
  if (!ratios[0] || !ratios[1]) return false;
  const double off = std::log(*ratios[0] / *ratios[1]), exchanged = off + 2.0 * std::log(solids[1].radius / solids[0].radius);
  return std::abs(exchanged) < std::abs(off) - kOtherSize;
}

ScaleError error_by_scale(const Solution& solution, const ScaleRatios& ratios) {
  Problem problem = solution.problem;
  if (problem.fixed) return {};  // what bounces alone has no size to touch with
  bool another = false;
  for (int body = 0; body < 2; ++body) {
    Solid& solid = problem.solids[static_cast<std::size_t>(body)];
    const std::optional<double>& ratio = ratios[static_cast<std::size_t>(body)];
    if (!solid.is_sphere() || !ratio || !is_another_scale(solid, *ratio)) continue;
    another = true;
    solid.radius /= *ratio;
    solid.mass.extent /= *ratio;
    solid.mass.reach /= *ratio;
    solid.mass.inertia /= *ratio * *ratio;
    for (PointObservation& seen : problem.points)
      if (seen.body == body) seen.depth /= *ratio;
  }
  if (!another) return {};
  const Fit fit = settle(problem, solution.fit.state);
  if (!fit.usable) return {};
  return {std::abs(bounded_restitution(problem, fit.state) - bounded_restitution(solution.problem, solution.fit.state)),
          std::abs(fit.state.mass_ratio - solution.fit.state.mass_ratio)};
}

}  // namespace unseen::collision
