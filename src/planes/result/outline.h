// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/planes/types.h"

namespace unseen::planes {

/// Outline with holes of points on a plane, from their raster of cells of edge `cell` (m) along `u` and `v`,
/// gaps up to about four cells closed. The largest connected part counts. Empty without points.
Polygon outline(const std::vector<Vec3>& points, const Plane& plane, const Vec3& u, double cell);

/// m², the outline's area less its holes'.
double area_of(const Polygon& polygon, const Vec3& normal);

}  // namespace unseen::planes
