// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// Whether most places (px) are one for so long that a fall with this acceleration (px per unit of time squared) would have moved them apart: something holds the body.
bool stands_still(const std::vector<Vec2>& places, const std::vector<double>& times, double acceleration);

/// Which of two free bodies lies still until it is hit, as one on a table or a tee does; two that lie do not meet. Sizes tell how far a fall would be in the picture,
/// and whether it is one along the view.
std::array<bool, 2> at_rest(const Problem& problem);

}  // namespace unseen::collision
