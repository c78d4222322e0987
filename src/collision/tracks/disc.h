// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/video/regions.h"

namespace unseen::collision {

/// A ball's outline, pixels.
struct Disc {
  Vec2 center = Vec2::Zero();
  double diameter = 0;
};

/// True if the region is a disc and nothing of it is missing or blurred.
bool is_disc(const Region& region);

/// Whether a region that something seems to cut is nearly all of a disc: a ball that lies on something ends there, too.
bool is_nearly_whole(const Region& region);

/// The disc that a region is a part of: something covers the rest, or it is shaded and looks like the background. Nothing if hardly
/// anything is missing, or the outline is not mostly a circle's with the rest inside (random sample consensus, Fischler and Bolles,
/// 1981, then least squares). `wholes`: diameters of regions that are discs, ascending; some must be like the result, for a blurred ball
/// has an outline much like a covered one's.
std::optional<Disc> covered_disc(const Region& region, const std::vector<double>& wholes);

}  // namespace unseen::collision
