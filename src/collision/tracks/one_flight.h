// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/tracks/candidates.h"

namespace unseen::collision {

/// Whether points are of one flight: a parabola in space, as any camera sees it. In pictures of a camera that looks down it is no parabola, and longer ones
/// fall apart when they are taken for such. `noise` (px) is that of a point.
bool is_one_flight(const std::vector<Candidate>& points, double noise);

}  // namespace unseen::collision
