// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/moments.h"

#include <gtest/gtest.h>

#include <vector>

#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

Moments of_point(const Vec3& p) {
  return {1.0, p, Mat3::Zero()};
}

std::vector<Vec3> random_points(std::size_t count, std::uint64_t seed, const Vec3& size, const Vec3& origin) {
  Random random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(origin + Vec3(random.normal(), random.normal(), random.normal()).cwiseProduct(size));
  return points;
}

/// Two passes over the points, without merging anything.
Moments direct(const std::vector<Vec3>& points) {
  Moments m;
  m.count = static_cast<double>(points.size());
  for (const Vec3& p : points) m.mean += p / m.count;
  for (const Vec3& p : points) m.scatter += (p - m.mean) * (p - m.mean).transpose();
  return m;
}

TEST(Moments, MergedInAnyGroupingEqualDirectSums) {
  const auto points = random_points(500, 3, {2, 0.5, 0.1}, {10, -20, 5});
  const Moments expected = direct(points);
  for (const std::size_t group : {1u, 7u, 250u, 499u}) {
    Moments all;
    for (std::size_t at = 0; at < points.size(); at += group) {
      Moments part;
      for (std::size_t i = at; i < std::min(points.size(), at + group); ++i) part += of_point(points[i]);
      all += part;
    }
    EXPECT_EQ(all.count, 500.0);
    EXPECT_LT((all.mean - expected.mean).norm(), 1e-12);
    EXPECT_LT((all.scatter - expected.scatter).norm(), 1e-9 * expected.scatter.norm());
  }
}

TEST(Moments, EmptyOnesChangeNothing) {
  const Moments m = direct(random_points(20, 4, {1, 1, 1}, {1, 2, 3}));
  const Moments left = Moments() + m, right = m + Moments();
  EXPECT_EQ(left.mean, m.mean);
  EXPECT_EQ(right.mean, m.mean);
  EXPECT_EQ(left.scatter, m.scatter);
  EXPECT_EQ(right.scatter, m.scatter);
  EXPECT_EQ((Moments() + Moments()).count, 0.0);
}

TEST(Moments, SquaredDistancesEqualTheSumOverPoints) {
  const auto points = random_points(200, 5, {1, 2, 3}, {4, 4, 4});
  Moments m;
  for (const Vec3& p : points) m += of_point(p);
  const Vec3 n = Vec3(1, 2, -1).normalized();
  double sum = 0;
  for (const Vec3& p : points) sum += std::pow(n.dot(p) - 0.7, 2);
  EXPECT_NEAR(m.squared_distances(n, 0.7), sum, 1e-9 * sum);
}

/// Eight corners of a slab a > b > c about the origin: every figure of its fit is known in closed form.
TEST(FitPlane, SlabInClosedForm) {
  const Mat3 turn =
      (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::AngleAxisd(-1.1, Vec3::UnitX()))
          .toRotationMatrix();
  const Vec3 half(3.0, 1.5, 0.25), center(100, -50, 7);
  Moments m;
  for (int corner = 0; corner < 8; ++corner)
    m += of_point(center + turn * Vec3(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                                       corner & 4 ? half.z() : -half.z()));
  const PlaneFit fit = fit_plane(m, {});
  EXPECT_LT(line_angle(fit.normal, turn.col(2)), 1e-9);
  EXPECT_LT(line_angle(fit.u, turn.col(0)), 1e-9);
  EXPECT_LT(line_angle(fit.v, turn.col(1)), 1e-9);
  EXPECT_NEAR(fit.rms, 0.25, 1e-9);
  EXPECT_NEAR(fit.spread_u, 3.0, 1e-9);
  EXPECT_NEAR(fit.spread_v, 1.5, 1e-9);
}

TEST(FitPlane, NoDirectionLeavesLessThanTheFit) {
  Moments m;
  for (const Vec3& p : random_points(300, 6, {1.0, 0.6, 0.3}, {0, 0, 0})) m += of_point(p);
  const PlaneFit fit = fit_plane(m, {});
  const double least = m.squared_distances(fit.normal, fit.normal.dot(m.mean));
  EXPECT_NEAR(least, fit.rms * fit.rms * m.count, 1e-9 * least);
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 n = random.direction();
    EXPECT_GE(m.squared_distances(n, n.dot(m.mean)), least * (1 - 1e-12));
  }
}

/// A drawing's line in each of the three coordinate planes; four points of a rectangle 2×0.2 turned by 30°.
TEST(FitPlane, LineOfADrawingInClosedForm) {
  for (int axis = 0; axis < 3; ++axis) {
    Space space;
    space.flat_axis = Vec3::Unit(axis);
    const Vec3 x = Vec3::Unit((axis + 1) % 3), y = Vec3::Unit((axis + 2) % 3);
    const double a = radians(30);
    const Vec3 along = std::cos(a) * x + std::sin(a) * y, across = -std::sin(a) * x + std::cos(a) * y;
    Moments m;
    for (const auto& [s, t] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}})
      m += of_point(5.0 * x + s * 2.0 * along + t * 0.2 * across);
    const PlaneFit fit = fit_plane(m, space);
    EXPECT_LT(line_angle(fit.normal, across), 1e-9);
    EXPECT_LT(line_angle(fit.u, along), 1e-9);
    EXPECT_NEAR(fit.spread_u, 2.0, 1e-9);
    EXPECT_NEAR(fit.rms, 0.2, 1e-9);
    EXPECT_EQ(fit.spread_v, 0.0);
    EXPECT_EQ(fit.v, *space.flat_axis);
    EXPECT_EQ(fit.normal.dot(*space.flat_axis), 0.0);
  }
}

TEST(Space, AdmissiblePartHasNothingAlongTheFlatAxis) {
  Space space;
  EXPECT_EQ(space.admissible(Vec3(1, 2, 3)), Vec3(1, 2, 3));
  space.flat_axis = Vec3::UnitZ();
  EXPECT_EQ(space.admissible(Vec3(1, 2, 3)), Vec3(1, 2, 0));
}

}  // namespace
}  // namespace unseen::planes
