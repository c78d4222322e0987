// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// The surfaces themselves say where one object ends and the next begins: planar faces are joined where they meet convexly or smoothly, never across a
/// concave edge nor from one piece of a stack to another. Gives numbers of objects of the points of group 0, −1 = none.
std::vector<int> join_surfaces(const Observation& seen, const std::vector<int>& group, const std::vector<int>& piece_of_point);

}  // namespace unseen::cuboids
