// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "collision/describe.h"
#include "unseen/collision/options.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Solves each meeting of the tracks from its centres alone; meetings that no start leads to are left out, as are those off another thing. What is fixed and has no normal
/// counts as a level floor if the impulse is nearly vertical, as a plumb wall if it is nearly level. Sightings next to the impact change flights in `tracks`
/// where that explains them better. With `drag` = "estimate", all impacts share the drag that explains them best; without gravity or drag, what a table slows them by.
std::vector<SolvedImpact> solve_positions(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids,
                                          Tracks& tracks, double fps, Context& context);

/// Solves each impact again with what the others tell of the direction of gravity.
void share_gravity(std::vector<SolvedImpact>& impacts);

/// Solves bounces of a ball again that follow each other on the same floor: it is as high at each of them. That tells of motion along the view ray.
void share_floor(std::vector<SolvedImpact>& impacts);

/// Solves the impacts again with one restitution for all.
void share_restitution(std::vector<SolvedImpact>& impacts);

}  // namespace unseen::collision
