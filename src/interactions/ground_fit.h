// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/matching.h"
#include "unseen/core/context.h"

namespace unseen::interactions {

/// The camera's height and pitch under which scenelets that stand on the floor explain the detections best, searched around `start`.
/// Bodies tell it better than feet alone: heads, hips and knees at several depths all have their heights. What the take gives is kept.
Ground fit_ground(const Take& take, const std::vector<int>& persons, const Database& database, const Ground& start, const Context& context);

}  // namespace unseen::interactions
