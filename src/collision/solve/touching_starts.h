// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "collision/solve/linear_flights.h"
#include "collision/solve/problem.h"

namespace unseen::collision {

/// A state to start from, and what it costs (½ χ²).
struct Ranked {
  double cost = 0;
  State state;
};

/// Two known shapes: all ways in which they can touch, each with the impulse that explains the flights best. `base` has the impact's time, impulse
/// and mass ratio as the centres alone tell them; the flights are around that time. The states' law is the constant normal.
std::vector<Ranked> touching_starts(const Problem& problem, const State& base, const std::array<LinearFlight, 2>& flights);

}  // namespace unseen::collision
