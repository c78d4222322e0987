// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// Share of the readout, −½ to ½, after which the sensor reads a pixel's row. `turn`: degrees clockwise by which the picture was turned since.
double row_share(const Vec2& pixel, const Camera& camera, int turn);

/// Throws InputError where the camera is said to take longer for a picture than there is from one of its own to the next.
void check_readout(const Shot& shot, const Footage& footage, double fps);

/// Each point at the time at which its row was read.
Tracks with_rolling_shutter(Tracks tracks, const ShotCamera& camera, int turn);

}  // namespace unseen::collision
