// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/scan/scale.h"

namespace unseen::planes {

/// The width (m) of the pixels that a drawing consists of, whose coordinates come in steps of `raster`; 0 of scans, which are rounded at most.
double pixel_of(const Survey& survey, const Space& space, double raster);

/// The gap (m, between middles of pixels) between the dashes that most of a drawing in pixels of this width (m) consists of; 0 where most lines are drawn through. Gaps are no longer than dashes, nor than `farthest` (m).
double gap_of_dashes(const Survey& survey, const Space& space, double pixel, double farthest);

}  // namespace unseen::planes
