// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/solve.h"

#include <ceres/cost_function.h>
#include <ceres/covariance.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "collision/solve/noise.h"
#include "collision/solve/residuals.h"
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

/// Where the shapes meet in this state; nothing where a shape or its orientation is not known.
std::optional<Proximity> touch_of(const Problem& problem, const State& state) {
  const Solid& a = problem.solids[0];
  const double tolerance = 0.03 * a.mass.extent;
  if (!problem.has_pose(0)) return std::nullopt;
  if (problem.fixed) {
    const std::optional<Vec3> normal = problem.normal_of_fixed(state.down);
    if (!normal) return std::nullopt;
    const bool along_impulse = a.is_sphere() && !problem.friction && state.impulse.norm() > 0.0;
    Proximity near = nearest_to_plane(a, state.p[0], state.q[0], along_impulse ? Vec3(state.impulse.normalized()) : *normal, tolerance);
    if (problem.level && !along_impulse) near.law.kind = ContactLaw::Kind::level;
    return near;
  }
  if (!problem.has_pose(1)) return std::nullopt;
  return nearest(a, state.p[0], state.q[0], problem.solids[1], state.p[1], state.q[1], tolerance);
}

/// Where on an edge or face that meets a plane the impulse may have acted: as near as can be to the line of the impulse, which turned the body as was seen.
Vec3 start_on(const Feature& feature, const State& state) {
  const Vec3 n = feature.axes.col(0), to = feature.point - state.x;
  const double along = n.dot(state.impulse);
  if (std::abs(along) < 1e-9) return feature.point;
  const Vec3 off = state.impulse * (n.dot(to) / along) - to;
  Vec3 start = feature.point;
  for (int i = 1; i < 3; ++i) start += feature.axes.col(i) * std::clamp(feature.axes.col(i).dot(off), -feature.extent[i], feature.extent[i]);
  return start;
}

/// How the contact's normal follows the bodies, where it does not follow the impulse.
std::optional<ContactLaw> law_of(const Problem& problem, const State& state, const std::optional<Proximity>& touch) {
  if (!problem.friction) return std::nullopt;
  if (touch) return touch->law;
  const std::optional<Vec3> normal = problem.fixed ? problem.normal_of_fixed(state.down) : std::nullopt;
  if (!normal) return std::nullopt;
  ContactLaw law;
  law.kind = problem.level ? ContactLaw::Kind::level : ContactLaw::Kind::constant;
  law.a = *normal;
  return law;
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

/// A Ceres problem with the evaluation that its terms share.
struct Setup {
  Setup(const Problem& problem, const State& reference, const std::optional<Proximity>& touch)
      : evaluation(problem, reference, free_unknowns(problem)), ceres(options()), blocks(add_residuals(touch, evaluation, ceres)) {
    const auto [earliest, latest] = impact_times(problem);
    bound(kTime, earliest - reference.time, latest - reference.time);
    bound(kLogMass, std::log(1.0 / kMostRatio / reference.mass_ratio), std::log(kMostRatio / reference.mass_ratio));
  }
  double* steps() { return evaluation.steps.data(); }

  EvaluatedState evaluation;
  ceres::Problem ceres;
  std::vector<NamedBlock> blocks;

 private:
  ceres::Problem::Options options() {
    ceres::Problem::Options options;
    options.evaluation_callback = &evaluation;
    return options;
  }
  /// An unknown's step stays between the two, and may be none.
  void bound(int unknown, double low, double high) {
    const auto at = std::find(evaluation.free.begin(), evaluation.free.end(), unknown);
    if (at == evaluation.free.end()) return;
    const int i = static_cast<int>(at - evaluation.free.begin());
    ceres.SetParameterLowerBound(steps(), i, std::min(0.0, low));
    ceres.SetParameterUpperBound(steps(), i, std::max(0.0, high));
  }
};

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

/// Bounds on energy and restitution come last: on the way they would hold a solution back that leads to a better one within them.
Problem without_bounds(Problem problem) {
  problem.terms.energy = problem.terms.restitution = false;
  return problem;
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

/// Value and deviation of a function of the unknowns.
Estimate estimate(const Wide& value, const Eigen::MatrixXd& covariance) {
  Estimate e;
  e.value = value.a;
  e.sd = std::sqrt(std::max(0.0, value.v.dot(covariance * value.v)));
  e.low = e.value - 1.96 * e.sd;
  e.high = e.value + 1.96 * e.sd;
  return e;
}

}  // namespace

Fit approach(const Problem& problem, const State& start) {
  constexpr int kIterations = 40;
  Fit fit;
  fit.state = start;
  fit.state.law.reset();
  const Problem free = without_bounds(problem);
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
      fit.state.x = problem.fixed && !problem.solids[0].is_sphere() ? start_on(fit.touch->features[0], fit.state) : 0.5 * (fit.touch->point_a + fit.touch->point_b);
      descend(without_bounds(problem), fit.touch, kIterations, fit.state, fit.cost);
    }
    fit.state.law = law_of(problem, fit.state, fit.touch);
    fit.usable = descend(problem, fit.touch, kIterations, fit.state, fit.cost);
    if (!fit.usable || !fit.touch || (before && std::abs(fit.cost - cost_before) < 1e-6 * (1.0 + fit.cost))) break;
  }
  if (fit.usable) fit.terms = term_sizes(problem, fit);
  return fit;
}

void add_covariance(const Problem& problem, Fit& fit) {
  Problem normal = problem.restitution ? problem : without_bounds(problem);  // a bound that is reached says nothing of the noise
  if (problem.noise_power > 2.0) normal.pixel_sigma = equivalent_deviation(pixels_off(problem, fit.state), problem.noise_power);
  normal.noise_power = 2.0;
  Setup setup(normal, fit.state, fit.touch);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = -1;
  options.min_reciprocal_condition_number = 1e-14;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  const double* block = setup.steps();
  const std::vector<int>& free = setup.evaluation.free;
  fit.covariance = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  const std::vector<const double*> blocks = {block};
  if (!covariance.Compute(blocks, &setup.ceres)) return;
  Eigen::MatrixXd of_steps(free.size(), free.size());  // symmetric, so in either order
  if (covariance.GetCovarianceBlock(block, block, of_steps.data())) fit.covariance(free, free) = of_steps;
}

Estimate restitution_of(const Problem& problem, const Fit& fit) {
  return estimate(restitution<Wide>(problem, fit.state, wide_values_of(problem, fit.state)), fit.covariance);
}

Estimate mass_ratio_of(const Problem& problem, const Fit& fit) { return estimate(wide_values_of(problem, fit.state).mass_ratio, fit.covariance); }

Estimate energy_kept_of(const Problem& problem, const Fit& fit) {
  const StateT<Wide> s = wide_values_of(problem, fit.state);
  return estimate(kinetic_energy<Wide>(problem, s, true) / kinetic_energy<Wide>(problem, s, false), fit.covariance);
}

}  // namespace unseen::collision
