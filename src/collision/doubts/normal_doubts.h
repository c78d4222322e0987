// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/best_fit.h"

namespace unseen::collision {

/// Where a ball's impulse on a floor that is taken to be level leans as no friction on a ball without spin explains, a floor that is tilted so
/// far explains the flights alike: adds it to the solution's alternatives. Takes the fit's covariance.
void doubt_level(Solution& solution);

/// Where neither shapes nor a given normal tell how the bodies touch, the impulse's direction passes for the normal, and friction for lost
/// bounce (thesis Fig. 5.10): adds what the flights say of a contact with friction to the solution's alternatives.
void doubt_normal(Solution& solution);

/// Where nothing tells how a body turns that is no ball, a hit off its centre makes it spin, and what goes into that passes for lost bounce: adds
/// the restitution of such a hit to the solution's alternatives.
void doubt_lever(Solution& solution);

/// Part of the restitution's error that comes from the vertical, which all impacts of a shot share: products of two impacts' vectors are the
/// covariance of their errors. Takes the fit's covariance.
Vec3 error_by_vertical(const Problem& problem, const Fit& fit);

}  // namespace unseen::collision
