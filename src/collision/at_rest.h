// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/problem.h"

namespace unseen::collision {

/// Whether places (px) are one, where a fall would have moved them apart by `fall` between its ends and its middle: something holds the body.
bool stands_still(const std::vector<Vec2>& places, double fall);

/// Which of two free bodies lie still until they are hit, as one on a table or a tee does. Sizes tell how far a fall would be in the picture.
std::array<bool, 2> at_rest(const Problem& problem);

}  // namespace unseen::collision
