// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/describe.h"

namespace unseen::collision {

/// What a rolling shutter changes, as phones have it, where nobody says how long it takes: warns and lists the solution with it under `ambiguous` where
/// restitution would be another. How long it takes the flights seldom tell: it looks like a tilt of gravity.
void doubt_shutter(const Shot& shot, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context);

}  // namespace unseen::collision
