// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Corners of a convex polygon, counter-clockwise. m
using Polygon = std::vector<Vec2>;

double area(const Polygon& polygon);

/// What two convex polygons share; empty if that has no area.
Polygon intersection(const Polygon& a, const Polygon& b);

/// The ground under a box that stands upright.
Polygon footprint(const OrientedBox& box);

/// The ground under all parts of an object, as convex polygons that do not overlap: their areas add up.
std::vector<Polygon> footprint(const Object& object);

/// Distance of a segment to a convex polygon, 0 if they touch. m
double distance(const Vec2& from, const Vec2& to, const Polygon& polygon);

}  // namespace unseen::interactions
