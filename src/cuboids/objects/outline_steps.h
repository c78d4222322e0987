// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Heights (world, m, rising) at which the outline of a part steps, as that of cartons of unlike width upon each other does where their fronts are in line: from
/// there on it begins and ends elsewhere, and between these heights it is as wide everywhere. `across` is the horizontal direction of its front. Where it
/// steps on one side only, the step is a small part of its width: it could be two boxes side by side otherwise.
std::vector<double> outline_steps(const Observation& seen, const std::vector<int>& part, const Vec2& across);

}  // namespace unseen::cuboids
