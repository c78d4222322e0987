// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/collision/options.h"
#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Both motions, restitution and mass ratio of two bodies that collide once, or of one that bounces off something fixed, from
/// one video or from sightings of their centres (thesis Chapter 5). Throws InputError for a video or a shot that cannot be used;
/// a shot without a collision, or that the model does not fit, is a result with Status::infeasible.
Reconstruction reconstruct(const Shot& shot, const Options& options, Context& context);

}  // namespace unseen::collision
