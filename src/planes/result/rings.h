// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "unseen/planes/types.h"

namespace unseen::planes {

/// A plane's outline and its holes, as seen along its normal or from above.
struct Rings {
  std::vector<std::vector<Vec2>> rings;
  Eigen::AlignedBox2d box;

  bool contains(const Vec2& p) const;

  /// Points that are spread evenly over what lies inside: of a grid over the box, 16 a side.
  std::vector<Vec2> samples() const;
};

/// Along two axes; a line of a drawing has no width, and any height.
Rings rings_of(const ArrangedPlane& plane, const Vec3& u, const Vec3& v);

}  // namespace unseen::planes
