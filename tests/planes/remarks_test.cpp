// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "planes/result/remarks.h"
#include "planes/scenes.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

/// Whether a run on this cloud warns in these words.
bool warned(const PointCloud& cloud, const Options& options, const std::string& words) {
  const std::vector<std::string> warnings = test::run(cloud, options).result.summary.warnings;
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

PointCloud sphere() {
  PointCloud cloud;
  Random random(1);
  while (cloud.positions.size() < 30'000) {
    const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (p.norm() > 0.1 && p.norm() < 1.0) cloud.positions.push_back(2.0 * p.normalized());
  }
  return cloud;
}

/// A prism with walls of equal width around the z axis, m: from 100 on it passes for a cylinder.
PointCloud prism(int walls) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 30'000; ++i) {
    const double turn = 2.0 * kPi / walls, share = random.uniform(0, 1);
    const int wall = i % walls;
    const auto corner = [&](int k) { return Vec3(2.0 * std::cos(k * turn), 2.0 * std::sin(k * turn), 0.0); };
    cloud.positions.push_back((1.0 - share) * corner(wall) + share * corner(wall + 1) + random.uniform(0, 3) * Vec3::UnitZ());
  }
  return cloud;
}

TEST(Curves, AreSaidWhereAllIsCurved) {
  EXPECT_TRUE(warned(sphere(), test::with_scale(0.03), "curved"));
  EXPECT_TRUE(warned(prism(100), {}, "curved"));
}

TEST(Curves, NoPolygonOfFewWallsIsOne) {
  for (const int walls : {4, 6, 8, 12}) EXPECT_FALSE(warned(prism(walls), {}, "curved")) << walls;
}

TEST(Units, AreSaidWhereTheyCanHardlyBeMetres) {
  PointCloud metres = prism(4), millimetres = metres;
  for (Vec3& p : millimetres.positions) p *= 1000.0;
  EXPECT_FALSE(warned(metres, {}, "millimetres"));
  EXPECT_TRUE(warned(millimetres, {}, "millimetres"));
  EXPECT_FALSE(warned(millimetres, test::with_scale(80), "millimetres")) << "who gives a scale knows the units";
}

/// Three planes of one direction and one that is related to none; the second and the last are turned by 3°, so many standard errors.
std::string said_of_turned(double errors, std::size_t points) {
  Arrangement all;
  all.directions.resize(2);
  for (const int direction : {0, 0, 0, 1}) {
    ArrangedPlane plane;
    plane.direction = direction;
    plane.points = points;
    plane.turned = radians(all.planes.size() % 2 == 1 ? 3.0 : 0.1);
    plane.turned_error = plane.turned / errors;
    all.planes.push_back(plane);
  }
  Context context;
  warn_of_turned(all, context);
  const std::vector<std::string> warnings = context.take_warnings();
  return warnings.empty() ? "" : warnings.front();
}

TEST(Turned, RelatedPlanesWhosePointsCertainlySayOtherwiseAreNamed) {
  EXPECT_NE(said_of_turned(10.0, 100).find("1 plane is turned by more than 2° from what their own points say, up to 3°"), std::string::npos);
  EXPECT_NE(said_of_turned(10.0, 100).find("(id 1)"), std::string::npos);
  EXPECT_EQ(said_of_turned(5.0, 100), "");
  EXPECT_EQ(said_of_turned(10.0, 30), "") << "a few points have little to say";
}

}  // namespace
}  // namespace unseen::planes
