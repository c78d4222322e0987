// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "unseen/core/geometry.h"

/// Eigen's decompositions take seconds to compile wherever they are used: those that many files need are compiled once, in linear.cpp,
/// for the sizes that are listed there.
namespace unseen {

/// Solves A x = b for a symmetric, positive semidefinite A, by a pivoted LDLᵀ. N: 2, 3, 4, 6, 8 or Eigen::Dynamic.
template <int N>
Eigen::Vector<double, N> solve_symmetric(const Eigen::Matrix<double, N, N>& a, const std::type_identity_t<Eigen::Vector<double, N>>& b);

/// Eigenvalues, ascending, and unit eigenvectors, as columns.
template <int N>
struct SymmetricEigen {
  Eigen::Vector<double, N> values;
  Eigen::Matrix<double, N, N> vectors;
};
/// Of a symmetric matrix, of which the lower half is read. N: 2 or 3.
template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a);

/// The x of least ‖A x − b‖, for an A of full rank (column-pivoted QR).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The x of least norm among those of least ‖A x − b‖; pivots below `threshold` of the largest count as zero (default: rounding).
Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold = 0.0);

/// The orthonormal matrix that is nearest to one.
Mat3 nearest_orthonormal(const Mat3& a);

/// The least turn that takes one direction to another.
Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to);

}  // namespace unseen
