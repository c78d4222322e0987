// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <ceres/problem.h>

#include <optional>
#include <string>
#include <vector>

#include "collision/contact.h"
#include "collision/problem.h"

namespace unseen::collision {

/// One residual block with the name of the term that it belongs to.
struct NamedBlock {
  std::string term;
  ceres::ResidualBlockId id = nullptr;
};

/// Adds all terms of the problem to a Ceres problem over the kUnknowns numbers at `unknowns`, steps from `reference`. `touch` is where the
/// shapes meet at the impact, if they are known. Both references must outlive it.
std::vector<NamedBlock> add_residuals(const Problem& problem, const State& reference, const std::optional<Proximity>& touch, double* unknowns,
                                      ceres::Problem& ceres);

}  // namespace unseen::collision
