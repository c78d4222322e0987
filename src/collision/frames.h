// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"
#include "collision/tracks/frame_clock.h"

namespace unseen::collision {

/// Where body `o` is at a time by one impact's solution, before or after it, in world coordinates.
BodyState body_at(const SolvedImpact& impact, const Mat3& to_world, int o, bool after, double time);

/// The bodies in every frame in which they were seen to fly. The flight between two impacts goes over from the one's solution to the
/// other's, so that nothing jumps; if one of them does not fit, it is the other's.
std::vector<FramePose> frame_poses(const std::vector<SolvedImpact>& impacts, const Mat3& to_world, const Tracks& tracks, const FrameClock& clock);

}  // namespace unseen::collision
