// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/planes/types.h"

namespace unseen::planes {

/// How close offsets must be to count as equal (m). What is noisier than most, as a tread with the riser's foot, does not tell. Coordinates come in
/// steps of `rounding` (m).
double step_tolerance(const Arrangement& result, double rounding);

/// Runs of three planes and more that follow each other at equal steps, and rows of four and more with others between them; of parallel planes by rising offset.
void find_equal_steps(const std::vector<int>& by_offset, double tolerance, Arrangement& result);

}  // namespace unseen::planes
