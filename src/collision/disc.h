// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/regions.h"

namespace unseen::collision {

/// A ball's outline, pixels.
struct Disc {
  Vec2 center = Vec2::Zero();
  double diameter = 0;
};

/// The disc that a region is a part of: something covers the rest, or it is shaded and looks like the background. Nothing if the region
/// is a whole disc itself, or its outline is not mostly a circle's with the rest inside (random sample consensus, Fischler and Bolles,
/// 1981, then least squares).
std::optional<Disc> covered_disc(const Region& region);

}  // namespace unseen::collision
