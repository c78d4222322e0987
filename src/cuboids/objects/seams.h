// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/stack_levels.h"

namespace unseen::cuboids {

/// Parts (lists of points) over which the picture shows seams, as of equal cartons side by side, are cut there: straight lines that run over the whole part on
/// two of its sides and meet at their common edge. Prints and tapes seldom do. Adds to `stacks`, instead of the levels of such a part.
void find_seams(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, Stacks& stacks, const Context& context);

}  // namespace unseen::cuboids
