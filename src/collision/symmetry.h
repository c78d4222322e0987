// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::collision {

/// The rotations about the origin that map a set of points to itself, the identity first: 4 for the corners of a box with three different
/// edges, 8 for a square section, 24 for a cube. The points must not lie on one line.
std::vector<Mat3> rotations_of(const std::vector<Vec3>& points);

}  // namespace unseen::collision
