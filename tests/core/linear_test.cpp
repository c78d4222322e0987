// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "core/linear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace unseen {
namespace {

constexpr double kClose = 1e-9;

Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(engine); });
}

template <int N>
void expect_solved(int size) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Eigen::MatrixXd factor = random_matrix(size + 2, size, seed);
    const Eigen::Matrix<double, N, N> a = factor.transpose() * factor;
    const Eigen::Vector<double, N> x = random_matrix(size, 1, seed + 100);
    EXPECT_LT((solve_symmetric(a, a * x) - x).norm(), 1e-6) << size;
  }
}

TEST(Linear, SymmetricSystemsAreSolved) {
  expect_solved<2>(2);
  expect_solved<3>(3);
  expect_solved<4>(4);
  expect_solved<6>(6);
  expect_solved<8>(8);
  expect_solved<Eigen::Dynamic>(11);
}

TEST(Linear, EigenvaluesAscendAndVectorsAreUnit) {
  const SymmetricEigen<2> two = symmetric_eigen<2>((Eigen::Matrix2d() << 2.0, 1.0, 1.0, 2.0).finished());
  EXPECT_LT((two.values - Vec2(1.0, 3.0)).norm(), kClose);
  EXPECT_NEAR(std::abs(two.vectors.col(0).dot(Vec2(1.0, -1.0))), std::sqrt(2.0), kClose);
  const Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const SymmetricEigen<3> three = symmetric_eigen<3>(axes * Vec3(5.0, -1.0, 2.0).asDiagonal() * axes.transpose());
  EXPECT_LT((three.values - Vec3(-1.0, 2.0, 5.0)).norm(), kClose);
  EXPECT_NEAR(std::abs(three.vectors.col(0).dot(axes.col(1))), 1.0, kClose);
  EXPECT_NEAR(std::abs(three.vectors.col(2).dot(axes.col(0))), 1.0, kClose);
}

TEST(Linear, LeastSquaresLeaveARestAcrossTheColumns) {
  const Eigen::MatrixXd a = random_matrix(9, 4, 1);
  const Eigen::VectorXd b = random_matrix(9, 1, 2);
  EXPECT_LT((a.transpose() * (a * least_squares(a, b) - b)).norm(), kClose);
  EXPECT_LT((least_norm(a, b) - least_squares(a, b)).norm(), kClose);
}

TEST(Linear, OfManySolutionsTheShortestIsTaken) {
  const Eigen::MatrixXd twice = Eigen::MatrixXd::Ones(2, 2), nearly = Eigen::Vector2d(1.0, 1e-6).asDiagonal();
  EXPECT_LT((least_norm(twice, Vec2(2.0, 2.0)) - Vec2(1.0, 1.0)).norm(), kClose);
  EXPECT_LT((least_norm(nearly, Vec2(1.0, 1.0)) - Vec2(1.0, 1e6)).norm(), 1e-3);
  EXPECT_LT((least_norm(nearly, Vec2(1.0, 1.0), 1e-3) - Vec2(1.0, 0.0)).norm(), kClose);
}

TEST(Linear, TheRotationOfAPolarDecompositionIsNearest) {
  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(-1.0, 1.0, 0.5).normalized()).toRotationMatrix();
  const Eigen::MatrixXd factor = random_matrix(5, 3, 3);
  const Mat3 stretch = factor.transpose() * factor;
  EXPECT_LT((nearest_orthonormal(turn * stretch) - turn).norm(), kClose);
}

TEST(Linear, ATurnBetweenDirectionsIsTheLeast) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Vec3 from = random_matrix(3, 1, seed), to = random_matrix(3, 1, seed + 50);
    const Eigen::Quaterniond turn = turn_between(from, to);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), kClose);
    EXPECT_NEAR(turn.angularDistance(Eigen::Quaterniond::Identity()), std::acos(from.normalized().dot(to.normalized())), 1e-7);
  }
  EXPECT_LT((turn_between(Vec3::UnitX(), -Vec3::UnitX()) * Vec3::UnitX() + Vec3::UnitX()).norm(), kClose);
}

}  // namespace
}  // namespace unseen
