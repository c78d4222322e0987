// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/solve/best_fit.h"
#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"

namespace unseen::collision {

struct Held {
  double seconds = 0;  ///< from its last sighting in flight to the first one after
  double off = 0;      ///< px from where its flights lead, at most
};

/// Whether a body was carried from one flight to the next, as by a hand that catches a ball and throws it up again: what was seen of it at the end of
/// the one is, from frame to frame, connected with what was seen at the start of the other, and is not where the flights lead. (Behind
/// something that stands still nothing is seen in between.)
std::optional<Held> held_between_flights(const Footage& footage, const ShotCamera& camera, const Tracks& tracks, const Solution& solution, int body);

}  // namespace unseen::collision
