// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>

#include "report/triangulate.h"
#include "unseen/planes/types.h"

namespace unseen::report {

/// Sizes of a plane's polygon, measured in the plane. Zero without a polygon.
struct PolygonSize {
  double perimeter = 0;          ///< m, of the outline; holes do not count
  double width = 0, height = 0;  ///< m, see polygon_size
  std::size_t holes = 0;         ///< how many
  double hole_area = 0;          ///< m², of all of them
};

/// Width and height are the sides of a rectangle around the outline. "wall" and "vertical": horizontal and
/// upward (in the plane) extent. Other planes: longer and shorter side of the rectangle of least area.
PolygonSize polygon_size(const planes::ArrangedPlane& plane);

/// Longer and shorter side of the rectangle of least area, in any direction, around at least one point. One
/// of its sides lies along an edge of the convex hull (Freeman and Shapira, "Determining the minimum-area
/// encasing rectangle for an arbitrary closed curve", CACM 1975).
Vec2 smallest_rectangle(const Ring& points);

}  // namespace unseen::report
