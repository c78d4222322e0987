// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"
#include "unseen/planes/options.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// Turns a raw point cloud into a regular arrangement of planes: mutual angles are exact where the scene
/// supports it, and orientations that only a minority of the scene has survive (thesis, Chapter 3; Monszpart
/// et al., "RAPter: Rebuilding man-made scenes with regular arrangements of planes", SIGGRAPH 2015).
///
/// Reads `source` a few times from its start. Memory grows with the occupied space, not with the number of
/// points. Hands the plane of each point to `sink`, if there is one.
/// Throws InputError for input that cannot be used (no finite points, fewer than three distinct ones, all in
/// a line, a scale larger than the scene). summary.status is infeasible if there is no plane, cancelled if
/// the context's stop was requested; the arrangement is then empty and `sink` was not called to the end.
Arrangement find_planes(PointSource& source, const Options& options, Context& context,
                        const AssignmentSink& sink = {});

}  // namespace unseen::planes
