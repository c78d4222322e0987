// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <ceres/problem.h>

#include <optional>
#include <vector>

#include "collision/solve/problem.h"
#include "collision/solve/residuals.h"

namespace unseen::collision {

/// A Ceres problem of one impact, with the evaluation that its terms share. Unknowns that nothing tells of, or that are given, are held; the time of the impact and the mass ratio are bounded.
struct Setup {
  Setup(const Problem& problem, const State& reference, const std::optional<Proximity>& touch);
  double* steps() { return evaluation.steps.data(); }

  EvaluatedState evaluation;
  ceres::Problem ceres;
  std::vector<NamedBlock> blocks;
};

/// The same problem without bounds on energy and restitution.
Problem without_bounds(Problem problem);

}  // namespace unseen::collision
