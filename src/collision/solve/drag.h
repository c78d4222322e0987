// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "collision/describe.h"
#include "unseen/collision/options.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Drag of both bodies, 1/m: ρ·Cd·A/(2m).
using Drag = std::array<double, 2>;

/// Throws InputError if drag is to follow from the mass and size of a free body that lacks one of them.
void check_drag(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids);

/// The impacts solved again with this drag.
std::vector<SolvedImpact> with_drag(std::vector<SolvedImpact> impacts, const Drag& drag);

/// The drag that explains all impacts best. That of a second free body follows from the first one's by their sizes and their mass ratio.
Drag best_drag(const std::vector<SolvedImpact>& impacts);

/// Where drag was not asked for but explains the flights clearly better, by the bodies' masses or else the best one: warns, lists the solution
/// with it under `ambiguous`, and widens the restitutions to hold it. With drag that the masses give the model without does not fit. Drag that the masses
/// give and the flights cannot tell widens them too; where no mass is given, it is said if drag may matter. The doubt of a fitted drag is added. Nothing of all this without
/// gravity. Returns the χ² that drag saves.
double look_for_drag(const Shot& shot, const Options& options, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context);

}  // namespace unseen::collision
