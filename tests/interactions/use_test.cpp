// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/use.h"

#include <gtest/gtest.h>

#include "interactions/method_samples.h"
#include "interactions/scenelets_sample.h"

namespace unseen::interactions {
namespace {

const Object kChair = box_object(0, "chair", "seat", {0, 0, 0.42}, {0.5, 0.5, 0.08});
const Object kTable = box_object(1, "table", "top", {0, 0.7, 0.72}, {1.6, 0.8, 0.05});
const Object kShelf = box_object(2, "shelf", "shelf-2", {0, 0.8, 1.2}, {0.9, 0.3, 0.03});

Pose with_hand(Pose pose, const Vec3& at) {
  pose.col(right_wrist) = at;
  return pose;
}

TEST(Uses, ASeatIsUsedByWhoSitsOnIt) {
  EXPECT_TRUE(uses(simple_pose(1), kChair));
  EXPECT_FALSE(uses(simple_pose(0), kChair)) << "standing in it";
  EXPECT_FALSE(uses(Placement{{0.6, 0, 0}, 0} * simple_pose(1), kChair)) << "sitting beside it";
  EXPECT_TRUE(uses(Placement{{0.3, 0.1, 0}, 1} * simple_pose(1), kChair)) << "sitting on its edge";
  EXPECT_TRUE(uses(Placement{{3, 2, 0}, 1.1} * simple_pose(1), Placement{{3, 2, 0}, 0.4} * kChair));
  EXPECT_FALSE(uses(Placement{{0, 0, 0.5}, 0} * simple_pose(1), kChair)) << "on something higher";
}

TEST(Uses, ATableIsUsedByHandsOnIt) {
  EXPECT_FALSE(uses(simple_pose(0), kTable)) << "arms hang before it";
  EXPECT_TRUE(uses(with_hand(simple_pose(0), {0, 0.5, 0.8}), kTable));
  EXPECT_FALSE(uses(with_hand(simple_pose(0), {0, 0.5, 1.3}), kTable)) << "high above";
  EXPECT_FALSE(uses(with_hand(simple_pose(0), {0, 0.5, 0.4}), kTable)) << "below";
  EXPECT_FALSE(uses(with_hand(simple_pose(0), {0, 1.3, 0.8}), kTable)) << "beyond";
}

TEST(Uses, AShelfIsUsedByAHandAtIt) {
  EXPECT_FALSE(uses(simple_pose(0), kShelf));
  EXPECT_TRUE(uses(with_hand(simple_pose(0), {0, 0.5, 1.3}), kShelf));
  EXPECT_FALSE(uses(with_hand(simple_pose(0), {0, 0.2, 1.3}), kShelf));
}

TEST(Uses, HandsThatHangBesideATableOrAShelfUseNeither) {
  Pose stands = simple_pose(0);
  const Vec3 hip = stands.col(right_hip);
  const auto top_at = [](const Vec3& at) { return box_object(1, "table", "top", at, {0.5, 0.5, 0.05}); };
  const auto shelf_at = [](const Vec3& at) { return box_object(2, "shelf", "shelf", at, {0.5, 0.5, 0.05}); };
  const Vec3 hangs = hip + Vec3(0.15, 0.1, -0.1), leans = hip + Vec3(0.1, 0.4, -0.1);
  EXPECT_FALSE(uses(with_hand(stands, hangs), top_at(hangs)));
  EXPECT_FALSE(uses(with_hand(stands, hangs), shelf_at(hangs)));
  EXPECT_TRUE(uses(with_hand(stands, leans), top_at(leans)));
  EXPECT_TRUE(uses(with_hand(stands, leans), shelf_at(leans)));
  const Pose sits = simple_pose(1);
  const Vec3 lap = Vec3(sits.col(right_hip)) + Vec3(0, 0.1, 0.1);
  EXPECT_TRUE(uses(with_hand(sits, lap), top_at(lap))) << "hands of who sits at a table";
}

TEST(Uses, PartsThatNobodyUsesAreNone) {
  EXPECT_FALSE(uses(simple_pose(1), box_object(0, "chair", "back", {0, 0, 0.42}, {0.5, 0.5, 0.08})));
  EXPECT_FALSE(uses(simple_pose(1), Object{}));
}

TEST(UsedObjects, AreThoseUsedAroundTheMiddle) {
  const Scenelet sits = test::moving_scenelet(simple_pose(1), 0, {kChair, kTable, kShelf});
  EXPECT_EQ(used_objects(sits), (std::vector<bool>{true, false, false}));
  Scenelet writes = test::moving_scenelet(with_hand(simple_pose(1), {0, 0.5, 0.8}), 0, {kChair, kTable});
  EXPECT_EQ(used_objects(writes), (std::vector<bool>{true, true}));
  Scenelet late = test::moving_scenelet(simple_pose(0), 0, {kTable});
  late.poses.back() = with_hand(late.poses.back(), {0, 0.5, 0.8});  // half a second after the middle
  EXPECT_EQ(used_objects(late), (std::vector<bool>{false}));
  late.poses[9] = late.poses.back();  // 0.4 s after
  EXPECT_EQ(used_objects(late), (std::vector<bool>{true}));
}

TEST(UsedObjects, WhoWalksByUsesNeitherTableNorShelf) {
  const Pose reaching = with_hand(simple_pose(0), {0, 0.5, 0.8});
  EXPECT_EQ(used_objects(test::moving_scenelet(reaching, 1.0, {kTable})), (std::vector<bool>{false}));
  EXPECT_EQ(used_objects(test::moving_scenelet(reaching, 0.3, {kTable})), (std::vector<bool>{true}));
  EXPECT_EQ(used_objects(test::moving_scenelet(simple_pose(1), 0.6, {kChair})), (std::vector<bool>{true})) << "who drops onto a seat moves";
}

}  // namespace
}  // namespace unseen::interactions
