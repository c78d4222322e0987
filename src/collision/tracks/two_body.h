// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/candidates.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Flights of two free bodies before and after they collide (thesis Section 5.3.2). Several collisions: the clearest one, the others
/// counted. No collision: the longest flights of two things, and no meeting.
Tracks find_pair(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, double fps, double least_noise, Context& context);

}  // namespace unseen::collision
