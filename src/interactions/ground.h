// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Height and tilt of the camera above the floor that people stand on, and how sure feet make it.
struct GroundStart {
  Ground ground;
  int feet = 0;           ///< frames with someone upright whose ankle is seen
  double depth = 4.0;     ///< m, usual depth of those feet
  double below = 0;       ///< m, how far the floor is below the camera's axis at that depth
};

/// Of upright people whose ankles are seen, the length of the body in the picture tells the depth, and the lower ankle then lies at ankle
/// height. What the take gives is kept. Warns where nothing can be told.
GroundStart find_ground(const Take& take, Context& context);

}  // namespace unseen::interactions
