// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/spin_search.h"

namespace unseen::collision {

/// Least squares of the silhouettes of looks [begin, end) in a motion's six numbers.
class SilhouetteFit {
 public:
  using Residuals = Eigen::Matrix<double, kDirections, Eigen::Dynamic>;  ///< a column a look
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  SilhouetteFit(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin, std::size_t end);

  std::vector<Quat> path(const Turning& turning) const;
  Residuals residuals(const Turning& turning) const;
  /// Robust χ².
  static double cost(const Residuals& r);
  /// `move`: a turn (rad), and a change of momentum in units of momentum_unit().
  Turning moved(const Turning& turning, const Vector6& move) const;
  /// Gauss and Newton's normal equations, by forward differences, each look with its robust weight.
  void linearise(const Turning& turning, const Residuals& r, Matrix6& normal, Vector6& gradient) const;
  /// Momentum that turns the body by about 1 rad from end to end.
  double momentum_unit() const { return unit_; }
  /// The middle of the looks, s.
  double middle() const { return 0.5 * (looks_[begin_].time + looks_[end_ - 1].time); }

 private:
  const SpinBody& body_;
  const Camera& camera_;
  const std::vector<Look>& looks_;
  std::size_t begin_, end_;
  double unit_ = 1;
};

}  // namespace unseen::collision
