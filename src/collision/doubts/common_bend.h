// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/describe.h"
#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// The acceleration (m/s²) that all flights before and after impacts share, where gravity is said to be 0 and it explains how they bend clearly better than what slows each of them on its way:
/// something falls, slides on a table that is not level, or the camera does not look straight at it (perspective bends fast flights).
std::optional<double> common_bend(const Tracks& tracks, const std::vector<SolvedImpact>& impacts);

}  // namespace unseen::collision
