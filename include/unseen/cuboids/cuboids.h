// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Explains the visible points of a frame by boxes and completes these into the hidden part so that the whole is in
/// static equilibrium (thesis, Chapter 4; Shao, Monszpart et al., "Imagining the unseen: Stability-based cuboid
/// arrangements for scene understanding", SIGGRAPH Asia 2014).
///
/// Throws InputError for a frame that cannot be used (no depth, no plane to stand on, boxes of 100 m).
/// summary.status is infeasible if there is no object, time_limit if the search was cut short, cancelled if the
/// context's stop was requested.
Completion complete_cuboids(const RgbdFrame& frame, const Options& options, Context& context);

/// The same for boxes and supports that are known: `scene` gives T_world_camera, supports and cuboids with their
/// `initial` boxes. These may be turned by some 15° and sized a little wrong: each is fitted again to the points near it; sides of which
/// nothing was seen stay as given.
Completion complete_cuboids(const RgbdFrame& frame, const Completion& scene, const Options& options, Context& context);

}  // namespace unseen::cuboids
