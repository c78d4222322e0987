// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/doubts/uncertainty.h"

namespace unseen::collision {

/// Centres of filmed balls are off together along a flight, by kLopsided; a solve that takes each for itself trusts them too much where their curve
/// tells little, as of a ball that flies straight at a wall behind which the camera looks. There the change of its size tells more: the solution
/// is replaced by one that weighs the centres by their common error, if that makes the interval of the restitution narrower.
void weigh_common_error(Solution& solution, Uncertain& uncertain, int resamples, int seed, Context& context);

}  // namespace unseen::collision
