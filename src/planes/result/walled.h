// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "planes/result/rings.h"

namespace unseen::planes {

/// An upright plane, seen along its normal: level to the right, and up.
struct Wall {
  Plane plane;
  Vec3 along;
  Rings rings;
};

Wall wall_of(const ArrangedPlane& plane, const Vec3& up);

/// The share of the hull around a level plane along which walls rise from it by most of `height` (m), or hang from it if that is negative: nearly all
/// around a floor, half of it around a table in a corner.
double walled_share(const ArrangedPlane& level, double height, const Vec3& up, const std::vector<Wall>& walls);

}  // namespace unseen::planes
