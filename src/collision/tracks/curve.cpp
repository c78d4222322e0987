// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/curve.h"

#include <Eigen/Cholesky>

namespace unseen::collision {

void CurveSums::add(double u, const Vec2& pixel, double sign) {
  if (count_ == 0) base_ = pixel;
  const double w = u - origin_;
  const Vec3 row(1.0, w, 0.5 * w * w);
  const Vec2 p = pixel - base_;
  normal_ += sign * row * row.transpose();
  right_ += sign * row * p.transpose();
  squares_ += sign * p.squaredNorm();
  count_ += sign > 0.0 ? 1 : -1;
}

Curve CurveSums::fit(const Vec2& curvature, double weight) const {
  Mat3 normal = normal_;
  Eigen::Matrix<double, 3, 2> right = right_;
  normal(2, 2) += weight;
  right.row(2) += weight * curvature.transpose();
  const Eigen::LDLT<Mat3> solver(normal);
  const Eigen::Matrix<double, 3, 2> x = solver.solve(right);
  Curve curve;
  curve.origin = origin_;
  curve.position = base_ + x.row(0).transpose();
  curve.velocity = x.row(1).transpose();
  curve.curvature = x.row(2).transpose();
  curve.cofactor = solver.solve(Mat3::Identity());
  curve.count = count_;
  curve.squares = std::max(0.0, squares_ + weight * curvature.squaredNorm() - x.cwiseProduct(right).sum());
  return curve;
}

}  // namespace unseen::collision
