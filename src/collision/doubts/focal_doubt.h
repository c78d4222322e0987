// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/describe.h"
#include "collision/solve/best_fit.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Standard deviations.
struct FocalError {
  double restitution = 0, mass_ratio = 0;
};

/// What a focal length that is only assumed (`Problem::focal_assumed`) may have done to the result: how far it moves with much shorter and
/// much longer ones, as far as the flights fit these as well.
FocalError error_by_focal_length(const Solution& solution);

/// How many times as long as theirs the focal length is that the impacts of a shot, and what is usual, make most likely; 1 where they hardly
/// tell, or it is no guess. Balls of known size that come nearer, or fall below a tilted camera, tell it. `so_far`: how many times as long as the
/// guess theirs is.
double likelier_focal_length(const std::vector<SolvedImpact>& impacts, double so_far, const Context& context);

}  // namespace unseen::collision
