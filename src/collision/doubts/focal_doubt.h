// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/best_fit.h"

namespace unseen::collision {

/// Standard deviations.
struct FocalError {
  double restitution = 0, mass_ratio = 0;
};

/// What a focal length that is only assumed (`Problem::focal_assumed`) may have done to the result: how far it moves with much shorter and
/// much longer ones, as far as the flights fit these as well.
FocalError error_by_focal_length(const Solution& solution);

}  // namespace unseen::collision
