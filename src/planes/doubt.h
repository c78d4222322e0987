// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/select.h"

namespace unseen::planes {

/// How much of the systematic doubt (`Patch::systematic_u`, `_v`) a scene shows, as standard deviations, from 0.1 to 1: from how
/// far the patches of the frame that has most area are off it. 1 where too few of them are fitted well enough to tell.
double shown_doubt(const Patches& patches, const Selection& selection, const std::vector<Vec3>& locals);

/// Brings the systematic doubt of every patch from one share of its standard deviation at first to another. Of few points it keeps more.
void reduce_doubt(Patches& patches, double from, double to);

}  // namespace unseen::planes
