// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/collision/types.h"

namespace unseen::collision {

/// Directions spread evenly over the sphere (Fibonacci spiral).
std::vector<Vec3> sphere_directions(int count);

/// Orientations spread evenly over all rotations: `views` directions that the camera looks from, `turns` angles about each.
std::vector<Quat> rotation_grid(int views, int turns);

}  // namespace unseen::collision
