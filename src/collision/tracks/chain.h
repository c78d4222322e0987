// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/candidates.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Flights of one body, and where two of them meet at a bounce off something fixed: parabolas of the picture, or, of a filmed ball where these do not
/// meet, flights in space. `body` is its index, `least_noise` (px) what a
/// centroid is good for at best.
Tracks find_chain(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, int body, double fps, double least_noise, Context& context);

}  // namespace unseen::collision
