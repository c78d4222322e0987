// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <functional>

#include "collision/solve/best_fit.h"
#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// Which flight the sightings next to the impact belong to was decided before the impact's time was known. Those within half a frame of it are given to the other flight where that explains all of them better; `tracks` and `solution` follow. `solve` solves the meeting of
/// other tracks.
void settle_split(const std::function<Solution(const Tracks&)>& solve, const Tracks::Meeting& meeting, double frame_time, Tracks& tracks, Solution& solution);

}  // namespace unseen::collision
