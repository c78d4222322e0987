// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/tracks/candidates.h"

namespace unseen::collision {

/// Candidates whose frames are counted by what was seen: flights are followed from one to the next.
struct Counted {
  Candidates candidates;  ///< `frame` and `u` in steps
  double rate = 0;        ///< steps a second
};

/// Of a film with `times` of its frames (s): frames that a conversion repeated, and that have the time of the one before, are none.
Counted without_repeats(const Candidates& candidates, const std::vector<double>& times, double fps);

/// Of sightings that most frames lack: the step is the usual one between two that have some.
Counted by_sightings(const Candidates& candidates, double fps);

}  // namespace unseen::collision
