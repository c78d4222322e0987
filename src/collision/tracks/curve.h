// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/geometry.h"

namespace unseen::collision {

/// A flight in the picture: p(u) = position + velocity w + ½ curvature w², w = u − origin. Pixels and frame times.
struct Curve {
  double origin = 0;
  Vec2 position = Vec2::Zero(), velocity = Vec2::Zero(), curvature = Vec2::Zero();
  Mat3 cofactor = Mat3::Identity();  ///< covariance of (position, velocity, curvature) of either coordinate for σ = 1
  int count = 0;
  double squares = 0;                ///< sum of squared residuals, px², a prior's part included

  Vec2 at(double u) const { return position + (u - origin) * (velocity + 0.5 * (u - origin) * curvature); }
  Vec2 velocity_at(double u) const { return velocity + (u - origin) * curvature; }
  /// Variance of at(u), or of velocity_at(u), a coordinate, for σ = 1.
  double variance_at(double u) const { return variance({1.0, u - origin, 0.5 * (u - origin) * (u - origin)}); }
  double velocity_variance_at(double u) const { return variance({0.0, 1.0, u - origin}); }

 private:
  double variance(const Vec3& row) const { return row.dot(cofactor * row); }
};

/// Sums from which a curve is fitted by least squares, so that a longer span costs one addition.
class CurveSums {
 public:
  explicit CurveSums(double origin) : origin_(origin) {}
  void add(double u, const Vec2& pixel, double sign = 1.0);  ///< sign −1 takes it out again
  int count() const { return count_; }
  /// The fit to three points or more. With `weight` > 0 the curvature is drawn to `curvature`: one observation of it, of variance
  /// 1 / weight.
  Curve fit(const Vec2& curvature = Vec2::Zero(), double weight = 0.0) const;

 private:
  double origin_;
  int count_ = 0;
  Mat3 normal_ = Mat3::Zero();
  Eigen::Matrix<double, 3, 2> right_ = Eigen::Matrix<double, 3, 2>::Zero();
  double squares_ = 0;
  Vec2 base_ = Vec2::Zero();  ///< first pixel: keeps the sums small
};

}  // namespace unseen::collision
