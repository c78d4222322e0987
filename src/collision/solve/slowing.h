// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"

namespace unseen::collision {

/// The impacts of a planar shot solved again with the slowing by what all slide on that explains them best; as they are if none does better.
std::vector<SolvedImpact> slowed_by_table(std::vector<SolvedImpact> impacts);

/// Adds what the doubt of the slowing of a planar shot leaves in the result.
void add_doubt_of_slowing(const std::vector<SolvedImpact>& impacts, Reconstruction& result);

}  // namespace unseen::collision
