// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "cuboids/statics/interface.h"

namespace unseen::cuboids {

/// Where an edge of one solid lies along a parallel one of another, no more than `tolerance` (m) away, as in
/// a card house: two points, and the normal half-way between the outermost ones that separate the two. None
/// if two faces beside the edges face each other within `tolerance`: such solids meet in the corner of a
/// grid, and carry nothing.
std::optional<Interface> along_edges(const ConvexSolid& a, const ConvexSolid& b, double tolerance);

}  // namespace unseen::cuboids
