// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/estimates.h"

#include <ceres/covariance.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "collision/solve/noise.h"
#include "collision/solve/setup.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

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
