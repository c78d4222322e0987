// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::report {

/// Positions by vertex, and closed chains of vertices with the inside on their left.
using FlatPoints = std::vector<Vec2>;
using Chain = std::vector<std::uint32_t>;

/// True if the direction from b to `target` leaves into the inside at corner a → b → c.
inline bool leaves_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& target) {
  const double before = turn(a, b, target), after = turn(b, c, target);
  return turn(a, b, c) > 0 ? before > 0 && after > 0 : before > 0 || after > 0;
}

/// Joins holes to an outline by a bridge each, there and back, so that one chain is left. A hole from which no vertex is
/// seen lies outside and is left out.
Chain join_holes(const FlatPoints& points, const Chain& outline, std::vector<Chain> holes);

}  // namespace unseen::report
