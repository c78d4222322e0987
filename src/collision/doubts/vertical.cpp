// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/vertical.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "collision/solve/unknowns.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

using Mat2 = Eigen::Matrix2d;
using Tangent = Eigen::Matrix<double, 3, 2>;

/// The two tilts of the solver's unknowns, about this direction.
Tangent tilts_of(const Vec3& down) {
  Tangent tilts;
  tilts.col(0) = any_orthogonal(down);
  tilts.col(1) = down.cross(Vec3(tilts.col(0)));
  return tilts;
}

}  // namespace

Vertical expected_vertical(const Problem& problem) {
  Vertical expected;
  expected.precision = (Mat3::Identity() - problem.down * problem.down.transpose()) / (problem.down_sigma * problem.down_sigma);
  return expected;
}

Vertical seen_vertical(const Problem& problem, const Fit& fit) {
  const Mat2 covariance = fit.covariance.block<2, 2>(kDown, kDown);
  if (!(covariance.determinant() > 0.0)) return {};
  const Mat3 expected = expected_vertical(problem).precision;
  const Tangent tilts = tilts_of(fit.state.down);
  const SymmetricEigen<2> eigen = symmetric_eigen<2>(covariance.inverse() - tilts.transpose() * expected * tilts);
  Vertical seen;
  for (int i = 0; i < 2; ++i) {
    if (eigen.values[i] <= 0.0) continue;
    const Vec3 along = tilts * eigen.vectors.col(i);
    seen.precision += eigen.values[i] * along * along.transpose();
    seen.sum += along * along.dot(expected * fit.state.down);  // at the minimum it pulls as strongly as what was expected
  }
  return seen;
}

std::pair<Vec3, double> likeliest(const Vertical& vertical, const Vec3& near) {
  constexpr int kRounds = 5;
  Vec3 down = near;
  Mat2 precision = Mat2::Identity();
  for (int round = 0; round < kRounds; ++round) {
    const Tangent tilts = tilts_of(down);
    precision = tilts.transpose() * vertical.precision * tilts;
    const Eigen::Vector2d step = solve_symmetric(precision, tilts.transpose() * (vertical.sum - vertical.precision * down));
    if (!step.allFinite()) break;
    down = (down + tilts * step).normalized();
  }
  const double least = symmetric_eigen(precision).values[0];
  return {down, 1.0 / std::sqrt(std::max(1e-6, least))};
}

}  // namespace unseen::collision
