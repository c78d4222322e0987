// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// States to start the solver from, in closed form and best first (at most `count`): positions from linear equations, J and the mass ratio from
/// the changes of velocity, turning from pairs of orientations with several numbers of whole turns between them.
/// Empty if the points do not determine the flights.
std::vector<State> start_states(const Problem& problem, double time, int count);

}  // namespace unseen::collision
