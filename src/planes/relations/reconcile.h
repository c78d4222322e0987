// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/arrange.h"

namespace unseen::planes {

/// Which node and direction each patch has once frames have been reconciled.
struct Reconciled {
  std::vector<OrientationFrame> frames;
  std::vector<Constraint> constraints;
  std::vector<int> frame_of_patch, local_of_patch;
};

/// Frame by frame, the heaviest first: a frame that does not differ significantly from an earlier one joins it;
/// else each relation to an earlier frame that its patches do not contradict significantly becomes exact.
Reconciled reconcile(const Selection& selection, const Patches& patches, const std::vector<Vec3>& locals,
                     const AngleSet& angles, const Space& space);

}  // namespace unseen::planes
