// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Parts are cut at grooves that run round them; and those in whose convex hull much free space was seen, by the directions of their
/// faces and across their axes, where that leaves the least of it within the hulls of the pieces (approximate convex decomposition, by what is free
/// instead of by a surface). Pieces of what somebody named stay one object.
std::vector<ObjectPart> cut_parts(const Observation& seen, const DepthView& view, std::vector<ObjectPart> parts, Context& context);

}  // namespace unseen::cuboids
