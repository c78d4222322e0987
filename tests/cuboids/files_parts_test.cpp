// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <random>

#include "cuboids/files_sample.h"
#include "report/cuboid_parts.h"
#include "report/cuboids_structures.h"

namespace unseen::report {
namespace {

TEST(CuboidParts, SeenAndHiddenFillTheBoxOnce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    cuboids::Cuboid c = cuboids::sample_box(0, {uniform(random), uniform(random), uniform(random)}, 3 * uniform(random),
                                            {0.4, 0.3, 0.2});
    // The initial box is any part of it; in every fifth trial an end is that of the whole.
    for (int a = 0; a < 3; ++a) {
      const double h = c.box.half_size[a];
      const double low = trial % 5 == 0 ? -h : -h + 0.4 * h * (uniform(random) + 1),
                   high = h - 0.4 * h * (uniform(random) + 1);
      c.initial.center += c.box.axes.col(a) * (0.5 * (low + high));
      c.initial.half_size[a] = 0.5 * (high - low);
    }
    const OrientedBox seen = seen_box(c);
    const std::vector<OrientedBox> hidden = hidden_boxes(c);
    double volume = seen.volume();
    for (const OrientedBox& part : hidden) volume += part.volume();
    EXPECT_NEAR(volume, c.box.volume(), 1e-12);
    for (int k = 0; k < 200; ++k) {
      const Vec3 inside =
          c.box.center +
          c.box.axes * (c.box.half_size.cwiseProduct(Vec3(uniform(random), uniform(random), uniform(random))));
      int owners = seen.contains(inside);
      for (const OrientedBox& part : hidden) owners += part.contains(inside);
      EXPECT_EQ(owners, 1);
    }
  }
}

TEST(CuboidParts, WhatWasNotExtendedIsWhollySeen) {
  const cuboids::Completion c = cuboids::sample_completion();
  EXPECT_EQ(hidden_boxes(c.cuboids[1]).size(), 0u);
  ASSERT_EQ(hidden_boxes(c.cuboids[0]).size(), 1u);
  EXPECT_NEAR(hidden_boxes(c.cuboids[0])[0].volume(), c.extended_volume, 1e-12);
  EXPECT_TRUE(seen_part(c.cuboids[2]).is_empty());  // by symmetry
  EXPECT_NEAR(hidden_boxes(c.cuboids[2])[0].volume(), c.cuboids[2].box.volume(), 1e-12);
}

TEST(CuboidParts, CompletedIsWhatHoldsMoreThanWasSeen) {
  cuboids::Completion c = cuboids::sample_completion();
  EXPECT_TRUE(c.cuboids[0].is_completed());
  EXPECT_FALSE(c.cuboids[1].is_completed());
  EXPECT_TRUE(c.cuboids[2].is_completed());  // by symmetry
  c.cuboids[1].box.half_size.x() *= 1.005;
  EXPECT_FALSE(c.cuboids[1].is_completed());
}

TEST(CuboidParts, FixedContactsMakeGroups) {
  cuboids::Completion c = cuboids::sample_tower(6, 0);
  for (const int k : {1, 2, 4}) {  // 1–2, 2–3 and 4–5 of ids 1…6
    c.contacts[static_cast<std::size_t>(k)].kind = cuboids::ContactKind::fixed;
    c.contacts[static_cast<std::size_t>(k)].forces.clear();
  }
  auto groups = rigid_groups(c);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].cuboids, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(groups[1].cuboids, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(groups[2].cuboids, (std::vector<std::size_t>{5}));
  EXPECT_EQ(groups[0].support, -1);
  c.contacts[0].kind = cuboids::ContactKind::fixed;
  EXPECT_EQ(rigid_groups(c)[0].support, 0);
}

TEST(CuboidParts, WhoCarriesStandsFirst) {
  cuboids::Completion c = cuboids::sample_tower(3, 0);
  std::swap(c.contacts[2].a, c.contacts[2].b);  // 3 on 2, told from above: the force on 2 presses down
  for (Vec3& f : c.contacts[2].forces) f = -f;
  for (const CarriedContact& k : carried_contacts(c)) {
    EXPECT_EQ(k.to, k.from + 1);
    EXPECT_GT(k.force.z(), 0);
  }
  EXPECT_NEAR(carried_contacts(c)[2].force.z(), 0.3 * cuboids::kGravity, 1e-9);
}

TEST(CuboidParts, PointsOfADepthImageAreWhereTheCameraSawThem) {
  RgbdFrame frame;
  frame.camera = {100, 100, 1.5, 1.0, 4, 3};
  frame.depth.assign(12, 2.0f);
  frame.depth[5] = 0;
  frame.color.assign(12, {10, 20, 30});
  const RigidTransform pose = cuboids::sample_completion().T_world_camera;
  const DepthPoints points = depth_points(frame, pose, 1000);
  ASSERT_EQ(points.positions.size(), 11u);
  EXPECT_EQ(points.colors.size(), 11u);
  for (const Vec3& p : points.positions) EXPECT_NEAR((pose.inverse() * p).z(), 2.0, 1e-12);
  EXPECT_NEAR((pose.inverse() * points.positions[0]).x(), -1.5 / 100 * 2, 1e-12);
}

TEST(CuboidParts, PointsOfACloudCountFromItsViewpoint) {
  RgbdFrame here, there;
  here.cloud.positions = {{1, 2, 3}, {-1, 0.5, 4}};
  here.cloud.viewpoint = Vec3::Zero();
  there.cloud.viewpoint = Vec3(5, 2, -1);
  for (const Vec3& p : here.cloud.positions) there.cloud.positions.push_back(p + *there.cloud.viewpoint);
  const RigidTransform pose{Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix(), {0, 0, 2}};
  const DepthPoints points = depth_points(here, pose, 100), moved = depth_points(there, pose, 100);
  ASSERT_EQ(moved.positions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((points.positions[i] - pose * here.cloud.positions[i]).norm(), 1e-12);
    EXPECT_LT((moved.positions[i] - points.positions[i]).norm(), 1e-12);
  }
}

TEST(CuboidParts, SupportsAreDrawnUnderAllBoxes) {
  const cuboids::Completion c = cuboids::sample_tower(5, 0.04);
  const std::vector<Vec3> polygon = polygon_of(c.supports[0], c);
  ASSERT_EQ(polygon.size(), 4u);
  for (const cuboids::Cuboid& cuboid : c.cuboids)
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 along = polygon[(k + 1) % 4] - polygon[k];
      EXPECT_GT(along.cross(cuboid.box.center - polygon[k]).z(), 0)
          << "a box beside its ground, or the wrong way round";
    }
}

}  // namespace
}  // namespace unseen::report
