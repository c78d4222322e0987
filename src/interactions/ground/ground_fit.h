// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/ground/ground.h"
#include "interactions/matching/matching.h"

namespace unseen::interactions {

/// The camera's height and pitch under which scenelets that stand on the floor explain the detections best, searched around `start`.
/// Bodies tell it better than feet alone: heads, hips and knees at several depths all have their heights; feet hold the floor where they stand. What the take gives is kept.
Ground fit_ground(const Take& take, const Database& database, const GroundStart& start, const Context& context);

}  // namespace unseen::interactions
