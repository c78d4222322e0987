// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>

#include "collision/solve/best_fit.h"

namespace unseen::collision {

/// Distance by size over distance by gravity, a body; nothing for what is fixed, or if gravity hardly tells.
using ScaleRatios = std::array<std::optional<double>, 2>;
ScaleRatios scale_ratios(const Solution& solution);

/// Whether such a ratio is more than noise and projection explain.
bool is_another_scale(const Solid& solid, double ratio);

/// Whether two spheres would be as large, beside each other, as they look from where gravity has them, if each were the other one, and clearly are not
/// as they are. A wrong frame rate makes both too large, or too small.
bool look_exchanged(const Solution& solution);

/// Standard deviations.
struct ScaleError {
  double restitution = 0, mass_ratio = 0;
};

/// What spheres given too large or too small, or a wrong frame rate, did to the result, where size and gravity tell of different scales: how far
/// it moves with the sizes that gravity tells.
ScaleError error_by_scale(const Solution& solution, const ScaleRatios& ratios);

}  // namespace unseen::collision
