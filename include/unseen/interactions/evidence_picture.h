// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

struct EvidencePicture {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;  ///< sRGB, row by row
};

/// The map from above, +y up, +x right, the likeliest turn of each cell: what is sat on blue, tables orange, shelves green, brighter where
/// likelier, on black. Empty for a map without cells or probabilities.
EvidencePicture picture_of(const EvidenceMap& map, int pixels_per_cell);

}  // namespace unseen::interactions
