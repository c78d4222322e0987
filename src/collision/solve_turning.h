// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/describe.h"
#include "collision/orientations/orientations.h"
#include "unseen/collision/options.h"
#include "unseen/core/context.h"

namespace unseen::collision {

inline constexpr double kBeyondFlights = 0.25;  ///< of the time in which a body was seen: an orientation farther from that tells nothing

/// Solves an impact again with the bodies' orientations: those that the shot gives or else those that the film shows. Nothing changes if there
/// are none.
void solve_turning(const Shot& shot, const Options& options, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                   SolvedImpact& impact, Context& context);

}  // namespace unseen::collision
