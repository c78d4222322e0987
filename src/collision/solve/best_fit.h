// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/solve.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// The solution, others that explain the data nearly as well, and the problem with its noise as the residuals have it.
struct Solution {
  Problem problem;
  Fit fit;
  std::vector<Alternative> others;
  double score = 0;  ///< −log likelihood, to compare solutions whose noise differs
};

/// Solves from `starts` starts around `time` and keeps the lowest. `fit.usable` is false if none led anywhere.
Solution best_fit(const Problem& problem, double time, int starts, Context& context);

}  // namespace unseen::collision
