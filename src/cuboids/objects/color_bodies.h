// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/color_regions.h"

namespace unseen::cuboids {

/// Parts whose regions go on in other parts, on the same side and in the same colour, as where books lie in a pile nearly in line; their points in order.
/// `regions`: those of each part.
std::vector<std::vector<int>> joined_by_color(const Observation& seen, const std::vector<std::vector<int>>& parts,
                                              const std::vector<std::vector<ColorRegion>>& regions);

}  // namespace unseen::cuboids
