// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <map>
#include <string>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// A state that fits, and how well.
struct Fit {
  State state;
  bool usable = false;
  double cost = 0;                   ///< ½ χ², robust
  std::optional<Proximity> touch;    ///< of the shapes at the impact, if they are known
  std::map<std::string, double> terms;  ///< root mean square of each term's residuals, over their noise
  Eigen::MatrixXd covariance;        ///< of the kUnknowns parameters; 0 for what was held; empty until asked for
};

/// Down towards the nearest minimum, the contact point somewhere near the middle of the bodies.
Fit approach(const Problem& problem, const State& start);

/// A few steps down from a state in which the shapes nearly touch: tells which starts are worth settling.
Fit try_out(const Problem& problem, const State& start);

/// From there, or from a solution of a similar problem, to the minimum with the shapes, if they are known, touching at the impact.
Fit settle(const Problem& problem, const State& start);

}  // namespace unseen::collision
