// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/ground/upright.h"
#include "unseen/core/context.h"

namespace unseen::interactions {

/// The camera over the floor that bodies stand on, from where their ankles, hips and shoulders are seen:
/// somebody upright is foreshortened, grows towards the head, and leans away from the picture's middle; how
/// tall everybody is, and how long their legs, is not known exactly. `usual` is what is believed before
/// anybody is seen, with a diagonal covariance.
FloorBelief standing_floor(const Take& take, const FloorBelief& usual, const Context& context);

}  // namespace unseen::interactions
