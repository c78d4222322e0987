// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/planes/types.h"

namespace unseen::report {

using Ring = std::vector<Vec2>;
using Triangle = std::array<std::uint32_t, 3>;

/// Cuts a polygon into triangles: the outline is rings[0], the others are its holes; any orientation, no ring
/// repeats its first point. Indices count through the rings one after the other; triangles are
/// counter-clockwise. A ring that touches or crosses itself gives some overlap or a gap, never an endless
/// run. Holes are joined to the outline by a bridge each, then ears are cut off (Eberly, "Triangulation by
/// ear clipping"), near ones compared through a grid.
std::vector<Triangle> triangulate(const std::vector<Ring>& rings);

/// The same for a polygon in space; triangles are counter-clockwise seen from the tip of `normal`.
std::vector<Triangle> triangulate(const planes::Polygon& polygon, const Vec3& normal);

/// The rings of a polygon by their coordinates along two orthogonal unit vectors of its plane, seen from its
/// first point.
std::vector<Ring> flat_rings(const planes::Polygon& polygon, const Vec3& u, const Vec3& v);

/// Twice the signed area of a ring, positive if counter-clockwise.
double doubled_area(const Ring& ring);

}  // namespace unseen::report
