// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/planes/types.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {

/// Parallel projection: which way of the world is right and up in the picture, and towards the viewer. Unit
/// vectors.
struct View {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), toward = Vec3::UnitZ();
};

View top_view();
/// From the front right, 30° above the horizon.
View oblique_view();

/// Inline SVG of the plane polygons, far ones first, coloured by frame and shaded by slope; ceilings
/// above a floor are left out so that one sees inside. The largest planes carry their number.
std::string svg_of_planes(const planes::Arrangement& arrangement, const View& view, const std::string& label);

/// Inline SVG of at most `limit` points, coloured by plane.
std::string svg_of_points(const planes::Arrangement& arrangement, const PointSample& points, const View& view,
                          std::size_t limit, const std::string& label);

/// Inline SVG of a 2D arrangement: the points in grey, the segments coloured by frame.
std::string svg_of_segments(const planes::Arrangement& arrangement, const PointSample& points,
                            std::size_t limit, const std::string& label);

}  // namespace unseen::report
