// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <functional>
#include <vector>

#include "collision/describe.h"

namespace unseen::collision {

/// The impacts solved again with a value of something that they share and that is no unknown of the solver, as drag of the air.
using SolvedWith = std::function<std::vector<SolvedImpact>(double)>;

/// ½ χ² of all impacts; infinite if one is not usable.
double cost_of(const std::vector<SolvedImpact>& impacts);

/// The value from `low` to `high` that explains the impacts best, by golden sections.
double likeliest_value(const SolvedWith& with, double low, double high);

/// A value that was fitted: from 0 to `most`; `step`: what it is varied by to see what follows; `systematic`: what it is off by whatever the noise.
struct FittedValue {
  double value = 0, most = 0, step = 0, systematic = 0;
};

/// Adds what the doubt of a fitted value leaves in restitutions and mass ratio.
void add_doubt(const SolvedWith& with, const FittedValue& fitted, const std::vector<SolvedImpact>& impacts, Reconstruction& result);

}  // namespace unseen::collision
