// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/stack_levels.h"

namespace unseen::cuboids {

/// Parts (lists of points) over which the picture shows seams, as of equal cartons side by side, are cut there: straight dark lines that run over the whole of
/// two of its sides, where both meet; over its front alone where the part has a step, or where another piece stands on it and hides its top. What is printed on one side, bands, lids and
/// straps are none. No piece has less than `fewest` points. Adds to `stacks`, together with the levels and rows of what is between seams.
void find_seams(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, std::size_t fewest, Stacks& stacks, const Context& context);

}  // namespace unseen::cuboids
