// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "interactions/ground/ground.h"

namespace unseen::interactions {

/// The floor under a camera that looks down on people, from the middles of their ankles, hips and shoulders: someone upright is foreshortened,
/// grows towards the head, and leans away from the picture's middle. `start` is what the length of bodies says as if they stood across the
/// view, which is too level. Nothing if no tilt between 8° and 80° explains the bodies, or, from a start below 8°, none far better.
std::optional<GroundStart> tilted_floor(const Take& take, const GroundStart& start, const Context& context);

}  // namespace unseen::interactions
