// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/geometry.h"

namespace unseen::interactions {

/// A quadratic cost of where something stands: qᵀAq + 2bᵀq + c of q = (cos θ, sin θ, x, y). Sums of such costs add up.
struct PlacementCost {
  Eigen::Matrix4d quadratic = Eigen::Matrix4d::Zero();
  Eigen::Vector4d linear = Eigen::Vector4d::Zero();
  double constant = 0;

  /// Adds that point `p` of what is placed should lie on rays through `center` (see Sight::information).
  void add(const Vec3& p, const Vec3& center, const Mat3& information);
  double at(double angle, const Vec2& position) const;
};

struct PlacementFit {
  double angle = 0;
  Vec2 position = Vec2::Zero();
  double cost = 0;
};

/// The placement of least cost: position eliminated, then the best angle on the circle. False if the cost does not tell the position.
bool fit_placement(const PlacementCost& cost, PlacementFit& best);

}  // namespace unseen::interactions
