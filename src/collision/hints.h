// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/describe.h"
#include "collision/evidence.h"

namespace unseen::collision {

/// Warns of what is given and tells nothing: fields that are not used, and orientations of a time at which nobody saw the body.
void warn_of_unused(const Shot& shot, const Tracks& tracks, Context& context);

/// Warns of sightings so far apart that few are of one flight.
void warn_of_far_sightings(const Shot& shot, double fps, Context& context);

/// Why no impact was found.
std::string nothing_found(const Shot& shot, const Tracks& tracks);

/// Warns of a body that something else that moves seems to have held: that did not collide.
void warn_of_held(const Shot& shot, const Evidence& evidence, const Problem& problem, Context& context);

/// Warns where a shot is said to be without gravity and all flights bend alike.
void warn_of_common_bend(const Shot& shot, const Tracks& tracks, const std::vector<SolvedImpact>& impacts, Context& context);

}  // namespace unseen::collision
