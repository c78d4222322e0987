// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "planes/scan/probes.h"

namespace unseen::planes {

/// How far apart (m) levels are on which the sample lies, as coarse depth leaves it; 0 where it does not. Steps of like size along two axes
/// are those of a model or a lattice.
double step_of_levels(const Survey& survey, const Space& space, const std::vector<Probe>& probes, double scale, const Context& context);

}  // namespace unseen::planes
