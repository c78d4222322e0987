// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>

#include "collision/solve/solve.h"

namespace unseen::collision {

/// rad, from 0 to π.
inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// What is known of the vertical, as −log likelihood: ½ gᵀ·precision·g − sum·g and a constant, of the unit direction g of gravity.
struct Vertical {
  Mat3 precision = Mat3::Zero();  ///< 1/rad²
  Vec3 sum = Vec3::Zero();

  void add(const Vertical& other, double weight) { precision += weight * other.precision, sum += weight * other.sum; }
};

/// What is expected of the vertical before anything is seen: `GravityTerm`.
Vertical expected_vertical(const Problem& problem);

/// What the flights of a solution tell of the vertical beyond what was expected. Takes the fit's covariance.
Vertical seen_vertical(const Problem& problem, const Fit& fit);

/// The likeliest direction of gravity, searched from `near`, and its deviation where it is known least, rad.
std::pair<Vec3, double> likeliest(const Vertical& vertical, const Vec3& near);

}  // namespace unseen::collision
