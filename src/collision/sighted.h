// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"

namespace unseen::collision {

/// What was seen to move in a video, the largest few of each frame; with its body where it is in one of the flights.
std::vector<Sighted> sighted_in(const Footage& footage, const Tracks& tracks);

}  // namespace unseen::collision
