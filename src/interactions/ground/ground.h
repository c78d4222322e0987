// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Height and tilt of the camera above the floor that people stand on, and how sure feet make it.
struct GroundStart {
  Ground ground;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< of camera_height (m) and the pitch's tangent
};

/// Of people who stand or walk, where they are seen and how large tells height and pitch. How tall each
/// person is, is unknown; cameras are expected where people set them up. What the take gives is kept. Warns
/// where nothing can be told, where the pitch is uncertain, and where the camera seems to be rolled.
GroundStart find_ground(const Take& take, Context& context);

}  // namespace unseen::interactions
