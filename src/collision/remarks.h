// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"
#include "unseen/collision/options.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Warns of a guessed camera; `told`: the flights told its focal length.
void warn_of_camera(const ShotCamera& camera, bool told, Context& context);

/// Warns of a camera that moves.
void warn_of_footage(const Footage& footage, Context& context);

/// Warns where much beside a body other than a ball was taken for its shadow, and nothing but its darkness says so.
void warn_of_dimmed(const Shot& shot, const Footage& footage, const Tracks& tracks, Context& context);

/// Warns where size and gravity tell of different scales, where flights contradict what is given of down, where sizes say that a shot without gravity slants, where the air seems to slow a body down, of several collisions, and says why the
/// model does not fit. Solutions that may be as right are added, and intervals hold them. Two bodies of a film that look alike in size may have been taken for each other: the result then has that as another solution.
void remark_on(const Shot& shot, const Options& options, const Tracks& tracks, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context);

}  // namespace unseen::collision
