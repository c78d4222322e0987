// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Coordinates that come in steps: text with few decimals, centres of voxels. What lies in one row of them seems to be level.
#include <gtest/gtest.h>

#include <set>

#include "planes/scan/scale.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// A room with a cabinet and small boxes along its walls, turned by `yaw` (deg).
PointCloud furnished(double yaw) {
  PointCloud cloud = test::box_cloud({0, 0, 0}, {6, 4, 2.6}, 0.02, 0.002, 1);
  const auto add = [&](const Vec3& corner, const Vec3& size) {
    const PointCloud box = test::box_cloud(corner, size, 0.02, 0.002, 7);
    cloud.positions.insert(cloud.positions.end(), box.positions.begin(), box.positions.end());
  };
  add({1, 0.5, 0}, {0.6, 1.2, 2});
  for (int i = 0; i < 4; ++i) add({2.5 + 0.8 * i, 2.2, 0.7}, {0.4, 0.3, 0.3});
  test::turn(cloud, Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()).toRotationMatrix());
  return cloud;
}

/// What is left of points when they are rounded to a step, each place once.
PointCloud rounded(const PointCloud& exact, double step) {
  std::set<std::array<long, 3>> places;
  for (const Vec3& p : exact.positions) places.insert({std::lround(p.x() / step), std::lround(p.y() / step), std::lround(p.z() / step)});
  PointCloud cloud;
  for (const auto& [x, y, z] : places) cloud.positions.push_back(step * Vec3(x, y, z));
  return cloud;
}

/// The planes that are neither level nor within 0.1° of the walls.
int turned_off(const Arrangement& result, double yaw) {
  int count = 0;
  for (const ArrangedPlane& p : result.planes) {
    const Vec3& n = p.plane.normal;
    count += std::abs(n.z()) < 0.9 && std::abs(std::remainder(degrees(std::atan2(n.y(), n.x())) - yaw, 90.0)) > 0.1;
  }
  return count;
}

TEST(Rounding, FurnitureIsNotLevelled) {
  for (const double yaw : {0.7, 3.0}) {
    const test::Run r = test::run(rounded(furnished(yaw), 0.01), Options());
    EXPECT_GE(r.result.planes.size(), 26u) << yaw;
    EXPECT_EQ(turned_off(r.result, yaw), 0) << yaw;
  }
}

TEST(Rounding, CentresOfVoxelsKeepTheirTurn) {
  const test::Run r = test::run(rounded(furnished(0.7), 0.04), Options());
  EXPECT_EQ(turned_off(r.result, 0.7), 0);
}

TEST(Rounding, StepsAreFoundAndNoneInFewPlaces) {
  Context context;
  const auto steps_of = [&](const PointCloud& cloud) {
    CloudSource source(cloud, "cloud");
    return rounding_of(survey(source, context));
  };
  EXPECT_NEAR(steps_of(rounded(furnished(20), 0.03)), 0.03, 1e-12);
  EXPECT_NEAR(steps_of(rounded(furnished(20), 0.04)), 0.04, 1e-12);
  EXPECT_EQ(steps_of(furnished(20)), 0.0);
}

/// A wall that rises by less than a step lies on two levels of the raster.
TEST(Rounding, LevelsAreNoIslands) {
  for (const double rise : {0.8, 1.5}) {
    PointCloud cloud;
    Random random(4);
    test::add_rectangle(cloud, {0, 0, 0}, {3, 0, rise * 0.04}, {0, 2, 0}, 0.02, 0.0, random);
    VoxelGrid grid = test::grid_of(rounded(cloud, 0.04), 0.06);
    EXPECT_FALSE(test::pieces_of(grid).empty()) << rise << ": two levels, where nothing says that they are steps of rounding";
    grid.raster = grid.rounding = 0.04;
    EXPECT_TRUE(test::pieces_of(grid).empty()) << rise;
  }
}

}  // namespace
}  // namespace unseen::planes
