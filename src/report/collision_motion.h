// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/collision/types.h"

namespace unseen::report {

/// A body's poses at each frame in which it flies and at each of its impacts, by time; neighbouring quaternions have the same sign.
struct Motion {
  std::vector<double> times;  ///< s, rising
  std::vector<Vec3> positions;
  std::vector<collision::Quat> rotations;

  /// Between two keys linear, beyond the ends held.
  Vec3 position(double time) const;
  collision::Quat rotation(double time) const;
};

Motion motion_of(const collision::Reconstruction& r, int body, double gravity);

/// Makes neighbouring quaternions have the same sign.
void keep_signs(Motion& motion);

/// Four corners of a plane, as wide as the points above it need it and `margin` beyond; none without points.
std::vector<Vec3> quad_below(const Plane& plane, const std::vector<Vec3>& points, double margin);

/// Four corners of what is fixed, in the world, as wide as the flights need it; none if nothing is known of it.
std::vector<Vec3> fixed_quad(const collision::Shot& shot, const collision::Reconstruction& r);

/// "ball"; "body 0" without a name.
std::string name_of(const collision::Reconstruction& r, int body);

}  // namespace unseen::report
