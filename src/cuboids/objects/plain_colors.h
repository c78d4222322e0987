// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/stack_levels.h"
#include "cuboids/surfaces/depth_view.h"

namespace unseen::cuboids {

/// Parts (lists of points) that are nothing but a few boxes, each of one plain colour, are cut where the colour changes: bricks of a wall, or books of a
/// row, whose sides are flush. Prints stay with what they are on: they lie within it, are a thin end of it, or lie in a band between two pieces of one
/// colour. Adds to `stacks`, instead of the levels of such a part.
void find_plain_colors(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, const DepthView& view, Stacks& stacks,
                       const Context& context);

}  // namespace unseen::cuboids
