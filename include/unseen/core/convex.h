// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen {

/// Corners of the convex hull, counter-clockwise; the two ends if the points lie on a line, one if they are all the same. A corner at
/// which twice the triangle's area is at most `flat` counts as lying on a side (Andrew, "Another efficient algorithm for convex hulls in
/// two dimensions", 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points, double flat = 0.0);

/// Whether `p` lies in a convex polygon, counter-clockwise, or at most `margin` outside each side's line. Nothing lies in an empty one.
bool inside_convex(std::span<const Vec2> polygon, const Vec2& p, double margin = 0.0);

}  // namespace unseen
