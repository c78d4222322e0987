// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/selection/select.h"

namespace unseen::planes {

/// How much of the systematic doubt (`Patch::systematic_u`, `_v`) a scene shows, as standard deviations, from 0.1 to 1: from how
/// far the patches of the frame that has most area are off it. 1 where too few of them are fitted well enough to tell.
double shown_doubt(const Patches& patches, const Selection& selection, const std::vector<Vec3>& locals);

/// The same from the angles at which patches adjoin. Boxes turned by little against each other scatter about a frame that they share as what is badly built does,
/// but their own edges are exact. 1 where too few tell.
double doubt_at_edges(const Patches& patches, const AngleSet& angles);

/// Selects frames; where the scene shows much less doubt than patches have, theirs is reduced to it and frames are selected again. Then
/// shares orientations out.
Selection select_as_built(Patches& patches, const AngleSet& angles, const Space& space, const Options& options, Context& context);

}  // namespace unseen::planes
