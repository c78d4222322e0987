// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Strips of curved surfaces are related to nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planes/patches/patches.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// Whether the first of some surfaces, which adjoin, is bowed beside the others.
bool bowed(const std::vector<PointCloud>& surfaces) {
  Context context;
  PointCloud cloud;
  for (const PointCloud& s : surfaces) cloud.positions.insert(cloud.positions.end(), s.positions.begin(), s.positions.end());
  VoxelGrid grid = test::grid_of(cloud, 0.04);
  Patches patches;
  std::vector<std::vector<int>> cells(surfaces.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    std::size_t nearest = 0;
    double least = 1e9;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      for (const Vec3& p : surfaces[s].positions)
        if (const double d = (p - grid.moments[i].mean).squaredNorm(); d < least) least = d, nearest = s;
    cells[nearest].push_back(static_cast<int>(i));
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    patches.patches.push_back(make_patch(grid, {}, cells[s], 0.0));
    if (s > 0) patches.adjoining.emplace_back(0, static_cast<int>(s));
  }
  mark_bowed(grid, context, patches);
  return patches.patches[0].bowed;
}

/// A strip of a cylinder, `begin` to `end` (rad) around it.
PointCloud arc(double radius, double begin, double end, double noise) {
  PointCloud cloud;
  Random random(1);
  for (double x = 0; x < 2.0; x += 0.02)
    for (double a = begin; a < end; a += 0.02 / radius) {
      const double r = radius + noise * random.normal();
      cloud.positions.push_back({x, r * std::sin(a), r * std::cos(a)});
    }
  return cloud;
}

TEST(Bowed, AreStripsOfPipesAndTanks) {
  for (const double radius : {0.15, 0.4, 1.0, 2.0}) {
    const double half = std::min(0.3, std::acos(1.0 - 0.04 / radius));
    EXPECT_TRUE(bowed({arc(radius, -half, half, 0.003), arc(radius, half, 3 * half, 0.003)})) << radius;
  }
}

TEST(Bowed, IsNothingThatIsFlatOrHasARim) {
  const auto rectangle = [](const Vec3& corner, const Vec3& u, const Vec3& v, double noise) {
    PointCloud cloud;
    Random random(2);
    test::add_rectangle(cloud, corner, u, v, 0.02, noise, random);
    return cloud;
  };
  for (const double angle : {5.0, 15.0, 30.0, 45.0, 55.0})  // bays, roofs and columns with corners
    for (const double width : {0.12, 0.3, 1.0})
      for (const double noise : {0.002, 0.008}) {
        const Vec3 across(0, width * std::cos(radians(angle)), -width * std::sin(radians(angle)));
        EXPECT_FALSE(bowed({rectangle({0, -width, 0}, {2, 0, 0}, {0, width, 0}, noise), rectangle({0, 0, 0}, {2, 0, 0}, across, noise)})) << angle << " " << width << " " << noise;
      }
  PointCloud tread = rectangle({0, 0, 0}, {1.2, 0, 0}, {0, 0.28, 0}, 0.003);
  for (const Vec3& p : rectangle({0, 0.28, 0}, {1.2, 0, 0}, {0, 0, 0.04}, 0.003).positions) tread.positions.push_back(p);  // with the foot of its riser
  EXPECT_FALSE(bowed({tread, rectangle({0, 0.28, 0.04}, {1.2, 0, 0}, {0, 0.05, 0.13}, 0.003)}));
}

// Two rows of points tell no bend across them, and points without noise do not tell one beyond what they are rounded to.
TEST(Bowed, IsNothingThatDoesNotTell) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    PointCloud rows, beside;
    for (double x = 0; x < 2.0; x += 0.05)
      for (const double y : {0.0, 0.08}) rows.positions.push_back({x, y, 0.002 * random.normal()});
    test::add_rectangle(beside, {0, 0.1, 0}, {2, 0, 0}, {0, 0.25, 0.12}, 0.03, 0.002, random);
    EXPECT_FALSE(bowed({rows, beside})) << seed;
  }
}

/// Six pipes of 3 m, 30 cm thick.
PointCloud pipes(Random& random) {
  PointCloud cloud;
  for (int p = 0; p < 6; ++p)
    for (double z = 0; z < 3.0; z += 0.02)
      for (int k = 0; k < 60; ++k) {
        const double angle = 2 * kPi * k / 60, radius = 0.15 + 0.003 * random.normal();
        cloud.positions.push_back({0.8 * (p % 3) + radius * std::cos(angle), 0.9 * (p / 3) + radius * std::sin(angle), z});
      }
  return cloud;
}

TEST(Bowed, PipesHaveNoRelationsAndTheRoomAboutThemKeepsItsOwn) {
  Random random(2);
  PointCloud cloud = pipes(random);
  const test::Run alone = test::run(cloud, Options());
  ASSERT_GT(alone.result.planes.size(), 20u);
  std::size_t related = 0;
  for (std::size_t a = 0; a < alone.result.planes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double angle = line_angle(alone.result.planes[a].plane.normal, alone.result.planes[b].plane.normal);
      related += angle < radians(0.005) || angle > radians(89.995);
    }
  EXPECT_LT(related, 10u);
  const auto& warnings = alone.result.summary.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("curved") != std::string::npos; }));

  const std::size_t of_pipes = cloud.size();
  for (const Vec3& p : test::box_cloud({-2, -2, 0}, {6, 5, 3}, 0.03, 0.003, 3).positions) cloud.positions.push_back(p);
  const test::Run room = test::run(cloud, Options());
  std::size_t right = 0;
  for (std::size_t i = of_pipes; i < cloud.size(); ++i) {
    const int p = room.plane_of_point[i];
    if (p < 0) continue;
    const Vec3 n = room.result.planes[p].plane.normal.cwiseAbs();
    right += n.maxCoeff() > std::cos(radians(0.05));
  }
  EXPECT_GT(static_cast<double>(right), 0.98 * static_cast<double>(cloud.size() - of_pipes));
}

/// Strips only, and so no frame at all.
TEST(Bowed, AConeAloneHasNoRelations) {
  Random random(4);
  PointCloud cone;
  for (int i = 0; i < 60'000; ++i) {
    const double height = 3.0 * std::sqrt(random.uniform()), angle = random.uniform(0, 2 * kPi), radius = 0.5 * height + 0.003 * random.normal();
    cone.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -height);
  }
  const Arrangement result = test::run(cone, Options()).result;
  EXPECT_GT(result.planes.size(), 5u);
  EXPECT_EQ(result.plane_relations, 0u);
}

}  // namespace
}  // namespace unseen::planes
