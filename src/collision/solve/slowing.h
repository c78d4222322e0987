// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"

namespace unseen::collision {

/// The impacts of a planar shot solved again where what the bodies slide on slows them all by so much, m/s².
std::vector<SolvedImpact> with_slowing(std::vector<SolvedImpact> impacts, double slowing);

/// The slowing, m/s², that explains all impacts of a planar shot best.
double best_slowing(const std::vector<SolvedImpact>& impacts);

/// Adds what the doubt of the slowing of a planar shot leaves in the result.
void add_doubt_of_slowing(const std::vector<SolvedImpact>& impacts, Reconstruction& result);

}  // namespace unseen::collision
