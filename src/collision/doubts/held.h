// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/solve/problem.h"
#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"

namespace unseen::collision {

/// For how long (s) a body was seen as one with something else that moves, from the end of one flight to the start of the next, which may have held it, as a hand that
/// catches a ball and throws it up again; nothing if it was not, or no longer than a bounce takes. What was seen of the body at the end of the one flight is, from frame to
/// frame, connected with what was seen at the start of the other.
std::optional<double> seconds_held(const Footage& footage, const Tracks& tracks, const Problem& problem, int body);

}  // namespace unseen::collision
