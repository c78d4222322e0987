// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/moments.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace unseen::planes {

PlaneFit fit_plane(const Moments& m, const Space& space) {
  PlaneFit fit;
  const double n = std::max(m.count, 1.0);
  const auto spread = [&](double eigenvalue) { return std::sqrt(std::max(eigenvalue, 0.0) / n); };
  if (space.is_2d()) {
    const Vec3 a = any_orthogonal(*space.flat_axis), b = space.flat_axis->cross(a);
    Eigen::Matrix2d s;
    s << a.dot(m.scatter * a), a.dot(m.scatter * b), b.dot(m.scatter * a), b.dot(m.scatter * b);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(s);
    const auto combine = [&](int i) { return Vec3(eigen.eigenvectors()(0, i) * a + eigen.eigenvectors()(1, i) * b); };
    fit.normal = combine(0);
    fit.u = combine(1);
    fit.v = *space.flat_axis;
    fit.rms = spread(eigen.eigenvalues()[0]);
    fit.spread_u = spread(eigen.eigenvalues()[1]);
    return fit;
  }
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(m.scatter);
  fit.normal = eigen.eigenvectors().col(0);
  fit.v = eigen.eigenvectors().col(1);
  fit.u = eigen.eigenvectors().col(2);
  // The closed form loses small eigenvalues; along its axes they are all there.
  fit.rms = spread(fit.normal.dot(m.scatter * fit.normal));
  fit.spread_v = spread(fit.v.dot(m.scatter * fit.v));
  fit.spread_u = spread(eigen.eigenvalues()[2]);
  return fit;
}

}  // namespace unseen::planes
