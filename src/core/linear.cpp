// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "core/linear.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace unseen {

template <int N>
Eigen::Vector<double, N> solve_symmetric(const Eigen::Matrix<double, N, N>& a, const std::type_identity_t<Eigen::Vector<double, N>>& b) {
  return a.ldlt().solve(b);
}
template Eigen::Vector<double, 2> solve_symmetric<2>(const Eigen::Matrix<double, 2, 2>&, const Eigen::Vector<double, 2>&);
template Eigen::Vector<double, 3> solve_symmetric<3>(const Eigen::Matrix<double, 3, 3>&, const Eigen::Vector<double, 3>&);
template Eigen::Vector<double, 4> solve_symmetric<4>(const Eigen::Matrix<double, 4, 4>&, const Eigen::Vector<double, 4>&);
template Eigen::Vector<double, 6> solve_symmetric<6>(const Eigen::Matrix<double, 6, 6>&, const Eigen::Vector<double, 6>&);
template Eigen::Vector<double, 8> solve_symmetric<8>(const Eigen::Matrix<double, 8, 8>&, const Eigen::Vector<double, 8>&);
template Eigen::VectorXd solve_symmetric<Eigen::Dynamic>(const Eigen::MatrixXd&, const Eigen::VectorXd&);

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}
template SymmetricEigen<2> symmetric_eigen<2>(const Eigen::Matrix2d&);
template SymmetricEigen<3> symmetric_eigen<3>(const Mat3&);

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return a.colPivHouseholderQr().solve(b); }

Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  if (threshold > 0.0) decomposition.setThreshold(threshold);
  decomposition.compute(a);
  return decomposition.solve(b);
}

Mat3 nearest_orthonormal(const Mat3& a) {
  const Eigen::JacobiSVD<Mat3> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to) { return Eigen::Quaterniond::FromTwoVectors(from, to); }

}  // namespace unseen
