// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/observation.h"

namespace unseen::cuboids {

/// Parts that nobody named, and whose surface two boxes one upon the other explain much better than one box can, are cut at the level between
/// them: a crate that is turned a little on another has its sides nearly in line with those below, and no gap.
std::vector<ObjectPart> cut_stacks(const Observation& seen, std::vector<ObjectPart> parts, Context& context);

}  // namespace unseen::cuboids
