// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"
#include "unseen/collision/options.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Whether an impact is one off something else than the fixed body, as that of a ball that comes back from a wall and lands: it fits as a push far
/// from the body's given normal, and not as one along it. Says so. `noise` (px): of the tracks.
bool is_off_something_else(const Shot& shot, const Options& options, double noise, double fps, const SolvedImpact& impact, Context& context);

/// Of a fixed body without a normal: leaves out, with a word of each, impacts that pushed far from where most did.
void keep_one_surface(const Shot& shot, const Options& options, double noise, double fps, std::vector<SolvedImpact>& impacts, Context& context);

}  // namespace unseen::collision
