// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/tracks/arcs.h"

namespace unseen::collision {

/// The arcs of the thing that moves most, then those of others that move nearly as much; the less a ball looks like a disc, as its shadow does, the less
/// they are worth.
std::vector<std::vector<Arc>> arcs_by_mover(const std::vector<Arc>& arcs, double noise);

}  // namespace unseen::collision
