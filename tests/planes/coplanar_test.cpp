// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Which parts of one direction lie in one plane: those whose offsets noise explains, however far apart they are.
#include <gtest/gtest.h>

#include <algorithm>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

constexpr double kNoise = 0.002;

/// Floors of 4 by 4 m, 2 m apart in a row, at the given heights, each with two walls.
PointCloud floors(const std::vector<double>& heights) {
  PointCloud cloud;
  Random random(11);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Vec3 corner(6.0 * static_cast<double>(i), 0, heights[i]);
    test::add_rectangle(cloud, corner, {4, 0, 0}, {0, 4, 0}, 0.03, kNoise, random);
    test::add_rectangle(cloud, corner, {4, 0, 0}, {0, 0, 2.5}, 0.03, kNoise, random);
    test::add_rectangle(cloud, corner, {0, 4, 0}, {0, 0, 2.5}, 0.03, kNoise, random);
  }
  return cloud;
}

/// The plane that most points of the i-th floor have.
int floor_of(const test::Run& r, const PointCloud& cloud, int i) {
  std::vector<int> votes(r.result.planes.size(), 0);
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const Vec3& p = cloud.positions[k];
    const bool inside = p.x() > 6.0 * i + 0.5 && p.x() < 6.0 * i + 3.5 && p.y() > 0.5 && p.z() < 0.5;
    if (inside && r.plane_of_point[k] >= 0) ++votes[static_cast<std::size_t>(r.plane_of_point[k])];
  }
  return static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

double height(const test::Run& r, int plane) { return std::abs(r.result.planes[static_cast<std::size_t>(plane)].plane.offset); }

TEST(Coplanar, LevelsThatDifferMoreThanNoiseStayApart) {
  const std::vector<double> levels = {0.100, 0.112, 0.100, 0.125, 0.080};
  const PointCloud cloud = floors(levels);
  const test::Run r = test::run(cloud, test::with_scale(0.08));
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(height(r, floor_of(r, cloud, i)), levels[static_cast<std::size_t>(i)], 0.001) << i;
}

TEST(Coplanar, OneLevelIsOnePlane) {
  const PointCloud cloud = floors({0.1, 0.112, 0.1});
  const test::Run r = test::run(cloud, test::with_scale(0.08));
  const int first = floor_of(r, cloud, 0), second = floor_of(r, cloud, 1), third = floor_of(r, cloud, 2);
  const auto together = [&](int a, int b) {
    return std::any_of(r.result.coplanar.begin(), r.result.coplanar.end(), [&](const auto& group) {
      return std::find(group.begin(), group.end(), a) != group.end() && std::find(group.begin(), group.end(), b) != group.end();
    });
  };
  EXPECT_TRUE(together(first, third));
  EXPECT_FALSE(together(first, second));
  EXPECT_EQ(height(r, first), height(r, third));
}

/// Floors of 3 by 6 m side by side at even steps, in a room.
PointCloud terraces(int count, double step) {
  PointCloud cloud;
  Random random(12);
  const double length = 3.0 * count;
  for (int i = 0; i < count; ++i) test::add_rectangle(cloud, {3.0 * i, 0, step * i}, {3, 0, 0}, {0, 6, 0}, 0.05, kNoise, random);
  for (const double y : {0.0, 6.0}) test::add_rectangle(cloud, {0, y, 0}, {length, 0, 0}, {0, 0, 3}, 0.05, kNoise, random);
  for (const double x : {0.0, length}) test::add_rectangle(cloud, {x, 0, 0}, {0, 6, 0}, {0, 0, 3}, 0.05, kNoise, random);
  return cloud;
}

// The steps are smaller than the scale, so one tilted plane would be near all points.
TEST(Coplanar, FloorsAtSmallStepsAreNeitherTiltedNorOne) {
  for (const double step : {0.03, 0.05})
    for (const int count : {2, 3, 4}) {
      const PointCloud cloud = terraces(count, step);
      const test::Run r = test::run(cloud, Options());
      EXPECT_GT(r.result.scale, 0.07);
      std::vector<double> heights;
      for (const ArrangedPlane& p : r.result.planes) {
        EXPECT_LT(std::min(line_angle(p.plane.normal, Vec3::UnitZ()), std::abs(0.5 * kPi - line_angle(p.plane.normal, Vec3::UnitZ()))), radians(0.02));
        if (line_angle(p.plane.normal, Vec3::UnitZ()) < 0.1) heights.push_back(p.plane.normal.z() * p.plane.offset);
      }
      std::sort(heights.begin(), heights.end());
      ASSERT_EQ(heights.size(), static_cast<std::size_t>(count)) << step;
      for (int i = 0; i < count; ++i) EXPECT_NEAR(heights[static_cast<std::size_t>(i)], step * i, 0.002) << step;
    }
}

// A floor that falls by 3 mm a metre in coordinates of two or three decimals lies on levels, which are no terraces.
TEST(Coplanar, LevelsOfRoundedCoordinatesAreOneFloor) {
  for (const double rounding : {0.01, 0.001}) {
    PointCloud cloud;
    Random random(13);
    test::add_rectangle(cloud, {0, 0, 0}, {10, 0, 0.03}, {0, 6, 0}, 0.03, 0.0, random);
    for (const double y : {0.0, 6.0}) test::add_rectangle(cloud, {0, y, 0}, {10, 0, 0.03}, {0, 0, 3}, 0.03, 0.0, random);
    for (const double x : {0.0, 10.0}) test::add_rectangle(cloud, {x, 0, 0.003 * x}, {0, 6, 0}, {0, 0, 3}, 0.03, 0.0, random);
    for (Vec3& p : cloud.positions) p = (p / rounding).array().round().matrix() * rounding + Vec3(412345.678, 5212345.678, 12.3);
    const test::Run r = test::run(cloud, Options());
    EXPECT_EQ(r.result.planes.size(), 5u) << rounding;
    const auto floor = std::find_if(r.result.planes.begin(), r.result.planes.end(), [](const ArrangedPlane& p) { return std::abs(p.plane.normal.z()) > 0.9; });
    ASSERT_NE(floor, r.result.planes.end());
    EXPECT_NEAR(degrees(line_angle(floor->plane.normal, Vec3(-0.003, 0, 1).normalized())), 0.0, 0.02) << rounding;
  }
}

}  // namespace
}  // namespace unseen::planes
