// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/doubts/scale_doubt.h"

namespace unseen::collision {

struct Uncertain {
  Estimate restitution, mass_ratio;
  Vec3 common = Vec3::Zero();  ///< part of the restitution's error that impacts of a shot share, as `error_by_vertical` has it
  ScaleRatios scale;           ///< distance by size over distance by gravity, a body
};

/// Value, deviation and 95 % interval of restitution and mass ratio: from the covariance, widened by what `resamples` solves on resampled
/// residuals scatter and by the basins that explain the data alike. Fills in the fit's covariance.
Uncertain uncertainty(Solution& solution, int resamples, int seed, Context& context);

}  // namespace unseen::collision
