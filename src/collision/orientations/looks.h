// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/pose_cost.h"
#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Frames of a flight in which its body is seen whole and alone, spread over the flight; without pictures.
std::vector<Look> choose_looks(const SpinBody& body, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                               const std::vector<Vec3>& centers, const FlightSpan& span);

/// Decodes the video once more and cuts out the pictures of all looks, without lens distortion and the camera's motion.
void read_pictures(const Shot& shot, const ShotCamera& camera, const Footage& footage, const std::vector<std::vector<Look>*>& flights,
                   Context& context);

}  // namespace unseen::collision
