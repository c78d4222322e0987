// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/tracks.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// Share of the readout, −½ to ½, that a row is read after the middle one.
double row_share(double row, int height);

/// Throws InputError where the camera is said to take longer for a picture than there is from one to the next.
void check_readout(const Shot& shot, double fps);

/// Each point at the time at which its row was read, frame by frame from the first row to the last.
Tracks with_rolling_shutter(Tracks tracks, const ShotCamera& camera);

}  // namespace unseen::collision
