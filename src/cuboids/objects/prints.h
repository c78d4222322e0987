// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/color_regions.h"
#include "cuboids/objects/extent.h"

namespace unseen::cuboids {

/// Merges labels, bands and ends of another colour with what they are on.
void merge_prints(const Observation& seen, const Directions& directions, std::vector<ColorRegion>& regions);

/// Whether two regions have all the colours that there are, two or more: what parts them is printed on them too, as on a checked box.
bool are_one_print(const std::vector<ColorRegion>& regions);

}  // namespace unseen::cuboids
