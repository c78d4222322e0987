// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Parts that are cut at levels, or at walls. The pieces between these are numbered 1, 2, … over all stacks: levels from below, rows along.
struct Stacks {
  std::vector<int> piece_of_point;  ///< 0 = in no stack
  std::vector<int> stack_of_piece;  ///< 0, 1, …; that of piece 0 is −1
};
Stacks no_stacks(const Observation& seen);

/// Parts (lists of points) whose surface boxes one upon another explain much better than one box can are stacks: a crate that is turned a little
/// on another has its sides nearly in line with those below, and no gap. Rows of boxes side by side, with steps between their tops or fronts, are parted
/// by walls where that explains them much better still. Normals must look away from the bodies, as those of one depth image do.
Stacks find_stacks(const Observation& seen, const std::vector<std::vector<int>>& parts, const Context& context);

}  // namespace unseen::cuboids
