// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "cuboids/box_fit.h"

namespace unseen::cuboids {

/// As bound(); but where that holds space that was seen free, no wider than what is above the foot: near the edge between a thing and what it stands on
/// noise leaves open whose a point is.
OrientedBox bound_above_foot(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                             double voxel);

}  // namespace unseen::cuboids
