// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/solve.h"

namespace unseen::collision {

/// Fills in the covariance of a fit.
void add_covariance(const Problem& problem, Fit& fit);

/// Value and standard deviation (delta method) of restitution, mass ratio, and kinetic energy after the impact over that before; the covariance
/// must be there.
Estimate restitution_of(const Problem& problem, const Fit& fit);
Estimate mass_ratio_of(const Problem& problem, const Fit& fit);
Estimate energy_kept_of(const Problem& problem, const Fit& fit);

}  // namespace unseen::collision
