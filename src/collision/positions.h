// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/evidence.h"
#include "collision/solve_impacts.h"

namespace unseen::collision {

/// Solves all impacts by the bodies' positions. A focal length that was a guess is replaced in `evidence` where the flights tell it, and two spheres that were taken for
/// each other are exchanged in it. Warns of a camera that is a guess.
std::vector<SolvedImpact> explain_positions(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, Context& context);

}  // namespace unseen::collision
