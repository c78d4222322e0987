// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "collision/describe.h"

namespace unseen::collision {

/// The restitution of each impact by itself.
std::vector<Estimate> restitutions_of(std::vector<SolvedImpact> impacts);

/// Widens the result's restitutions to hold those of another solution.
void widen_to_hold(const std::vector<SolvedImpact>& solved, Reconstruction& result);

/// The same with a solution whose χ² is lower by `saved`. Lists it under `ambiguous`, as `what`, where it is clearly better, or lies
/// outside the interval and is hardly worse. Nothing where no body bounces so.
void add_alternative(const std::string& what, const std::vector<SolvedImpact>& solved, double saved, Reconstruction& result);

}  // namespace unseen::collision
