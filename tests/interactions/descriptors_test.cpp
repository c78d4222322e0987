// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "interactions/database/footprint.h"
#include "interactions/scenelets_sample.h"
#include "unseen/core/error.h"
#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {
namespace {

/// Sits down while walking 0.4 m; `warp` bends the time.
std::vector<Pose> motion(int count, double warp) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double t = std::pow(i / (count - 1.0), warp);
    poses.push_back(Placement{{0.4 * t, 0, 0}, 0.5 * t} * simple_pose(t * t));
  }
  return poses;
}

TEST(JointLines, AreThoseOfAPoseWorkedOutByHand) {
  const Eigen::Matrix<double, kJointLines, 1> d = joint_line_distances(simple_pose(1));  // sits: thighs level, shins upright
  // knee (0.1, 0.4, 0.5) to the line from hip (0.1, 0, 0.5) to ankle (0.1, 0.4, 0.1): a right triangle with legs of 0.4 m
  EXPECT_NEAR(d[0], 0.4 / std::sqrt(2.0), 1e-12);
  // hip (0.1, 0, 0.5) to the line from shoulder (0.2, 0, 1) to knee (0.1, 0.4, 0.5)
  EXPECT_NEAR(d[4], Vec3(-0.1, 0, -0.5).cross(Vec3(-0.1, 0.4, -0.5)).norm() / Vec3(-0.1, 0.4, -0.5).norm(), 1e-12);
  EXPECT_NEAR(d[6], std::hypot(0.1, 0.4), 1e-12);    // knee to the upright spine
  EXPECT_NEAR(d[8], std::hypot(0.1, 0.4), 1e-12);    // ankle
  EXPECT_NEAR(d[10], std::hypot(0.25, 0.25), 1e-12);  // wrist
  EXPECT_NEAR(d[12], 0, 1e-12);                      // head
  EXPECT_NEAR(d[13], std::hypot(0.4, 0.4), 1e-12);   // pelvis to the line through the ankles
  EXPECT_NEAR(joint_line_distances(simple_pose(0))[13], 0.85, 1e-12);
}

TEST(MotionDescriptor, DoesNotDependOnSpeed) {
  const auto even = motion_descriptor(motion(200, 1.0));
  for (const double warp : {0.4, 2.0, 3.0}) EXPECT_LT((motion_descriptor(motion(600, warp)) - even).cwiseAbs().maxCoeff(), 2e-3) << warp;
  EXPECT_GT(motion_distance(even, motion_descriptor(std::vector<Pose>(5, simple_pose(0)))), 0.1);
}

TEST(MotionDescriptor, DoesNotDependOnTheFrame) {
  Random random(5);
  const std::vector<Pose> poses = motion(20, 1.0);
  for (int i = 0; i < 10; ++i) {
    const Placement placement = {{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-1, 1)}, random.uniform(-3, 3)};
    std::vector<Pose> moved;
    for (const Pose& pose : poses) moved.push_back(placement * pose);
    EXPECT_LT((motion_descriptor(moved) - motion_descriptor(poses)).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(MotionDescriptor, BeginsAndEndsWithTheMotion) {
  const std::vector<Pose> poses = motion(20, 1.0);
  const auto descriptor = motion_descriptor(poses);
  EXPECT_LT((descriptor.col(0).cast<double>() - joint_line_distances(poses.front())).norm(), 1e-5);
  EXPECT_LT((descriptor.col(kDescriptorPoses - 1).cast<double>() - joint_line_distances(poses.back())).norm(), 1e-5);
  EXPECT_THROW(motion_descriptor({}), InputError);
}

TEST(MotionDistance, WeighsTheMiddleMost) {
  Eigen::Matrix<float, kJointLines, kDescriptorPoses> none = decltype(none)::Zero(), middle = none, end = none, all = none;
  middle.col(kDescriptorPoses / 2).setConstant(0.1f);
  end.col(0).setConstant(0.1f);
  all.setConstant(0.1f);
  EXPECT_GT(motion_distance(none, middle), 2 * motion_distance(none, end));
  EXPECT_NEAR(motion_distance(none, all), 0.1 * std::sqrt(14.0), 1e-6);  // the weights sum to 1
}

TEST(Footprints, OfOverlappingPartsAddUpToTheirUnion) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    Object object{0, "couch", {}};
    for (int i = 0; i < 5; ++i)
      object.parts.push_back(box_object(0, "", "", Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0), Vec3(random.uniform(0.1, 1), random.uniform(0.1, 1), 1), random.uniform(-3, 3)).parts[0]);
    int inside = 0;
    constexpr int kSide = 400;  // samples a side of the square of ±1.3 m
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec3 p((i % kSide + 0.5) / kSide * 2.6 - 1.3, (i / kSide + 0.5) / kSide * 2.6 - 1.3, 0);
      inside += std::any_of(object.parts.begin(), object.parts.end(), [&](const Part& part) { return part.box.contains(p); });
    }
    double sum = 0;
    for (const Polygon& piece : footprint(object)) sum += area(piece);
    EXPECT_NEAR(sum, inside * std::pow(2.6 / kSide, 2), 0.01);
  }
}

TEST(Footprints, DistanceOfASegmentIsThatOfItsNearestPoint) {
  Random random(12);
  for (int round = 0; round < 50; ++round) {
    const Polygon box = footprint(box_object(0, "", "", Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0), Vec3(0.8, 0.3, 1), random.uniform(-3, 3)).parts[0].box);
    const Vec2 a(random.uniform(-2, 2), random.uniform(-2, 2)), b(random.uniform(-2, 2), random.uniform(-2, 2));
    double least = 1e9;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) least = std::min(least, (a + (b - a) * (i / 200.0) - (box[0] + (box[1] - box[0]) * (j % 15 / 14.0) + (box[3] - box[0]) * (j / 15 / 13.0))).norm());
    EXPECT_NEAR(distance(a, b, box), least, 0.04);
    EXPECT_LE(distance(a, b, box), least + 1e-9);
  }
}

TEST(LayoutDescriptor, OfABoxInTwoBinsIsSharedBetweenThem) {
  const int chair = category_index("chair") * kGrid * kGrid, middle = chair + 2 * kGrid + 2;
  const std::vector<float> layout = layout_descriptor({box_object(0, "chair", "seat", Vec3(0.26, 0, 0.4), Vec3(0.4, 0.4, 0.1))});
  EXPECT_NEAR(layout[middle], 0.5, 1e-5);
  EXPECT_NEAR(layout[middle + 1], 0.5, 1e-5);
  EXPECT_NEAR(std::accumulate(layout.begin(), layout.end(), 0.0), 1, 1e-5);
}

TEST(LayoutDescriptor, OfALargeBoxFillsItsBins) {
  const int table = category_index("table") * kGrid * kGrid;
  const std::vector<float> layout = layout_descriptor({box_object(0, "table", "top", Vec3(0, 0, 0.7), Vec3(20, 20, 0.1), 0.4)});
  for (int i = 0; i < kGrid * kGrid; ++i) EXPECT_NEAR(layout[table + i], 1, 1e-5);
}

TEST(LayoutDescriptor, TakesTheObjectThatCoversABinMost) {
  const int shelf = category_index("shelf") * kGrid * kGrid + 4 * kGrid + 2;  // straight ahead, farthest row
  const Object little = box_object(0, "shelf", "shelf", Vec3(0, 1.04, 1), Vec3(0.1, 0.1, 0.1)), wide = box_object(1, "shelf", "shelf", Vec3(0, 1.04, 1), Vec3(3, 0.26, 0.1));
  EXPECT_NEAR(layout_descriptor({little})[shelf], 1, 1e-5);
  EXPECT_NEAR(layout_descriptor({wide})[shelf], 0.5, 1e-5);
  EXPECT_NEAR(layout_descriptor({wide, little})[shelf], 1, 1e-5);
}

}  // namespace
}  // namespace unseen::interactions
