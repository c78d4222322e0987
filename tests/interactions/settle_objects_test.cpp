// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/settle_objects.h"

#include <gtest/gtest.h>

#include "interactions/scenelets_sample.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

FoundObject found(int id, const std::string& category, const Vec2& at, double confidence, double yaw = 0) {
  const bool table = category == "table";
  return {box_object(id, category, table ? "top" : "seat", {at.x(), at.y(), 0.4}, table ? Vec3(1.0, 0.6, 0.8) : Vec3(0.5, 0.5, 0.8), yaw), confidence, {}};
}

Passing passing(const Vec3& pelvis_at, const std::vector<int>& uses = {}) {
  return {{pelvis_at, pelvis_at + Vec3(0.1, 0.1, -0.4), pelvis_at + Vec3(-0.1, 0.1, -0.4)}, uses};
}

std::vector<Passing> walk(const Vec2& from, const Vec2& to, int steps) {
  std::vector<Passing> way;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 at = from + (to - from) * i / steps;
    way.push_back(passing({at.x(), at.y(), 0.9}));
  }
  return way;
}

TEST(StandingCost, IsWhatHandsCompute) {
  const FoundObject chair = found(0, "chair", {0, 0}, 1);  // 0.5 m × 0.5 m × 0.8 m on the floor
  const std::vector<FoundObject> alone = {chair}, two = {chair, found(1, "table", {0.5, 0}, 1)};
  EXPECT_EQ(standing_cost(chair.object, {0, 0}, alone, {}), 0);
  EXPECT_NEAR(standing_cost(chair.object, {0.2, 0}, alone, {}), 1, 1e-9);
  EXPECT_NEAR(standing_cost(chair.object, {0, 0}, two, {}), 1.5625, 1e-9);  // they share 0.25 m × 0.5 m = 0.125 m²
  const Vec3 away(9, 9, 9);
  const std::vector<Passing> hip = {{{Vec3(0.05, 0, 0.4), away, away}, {}}}, knee = {{{away, Vec3(0.2, 0, 0.4), away}, {}}};
  EXPECT_NEAR(standing_cost(chair.object, {0, 0}, alone, hip), 4, 1e-9);      // 0.2 m deep
  EXPECT_NEAR(standing_cost(chair.object, {0, 0}, alone, knee), 0.25, 1e-9);  // 0.05 m deep
  const std::vector<Passing> under = {{{away, Vec3(0.5, 0, 0.4), Vec3(0.5, 0, 0.4)}, {}}};
  std::vector<Passing> sits = hip;
  sits[0].uses = {7, 0};
  EXPECT_EQ(standing_cost(chair.object, {0, 0}, alone, sits), 0);
  EXPECT_EQ(standing_cost(two[1].object, {0, 0}, {}, under), 0) << "knees go under tables";
}

/// The best place of a grid of 5 cm within half a metre.
Vec2 best_shift(const Object& object, std::span<const FoundObject> others, std::span<const Passing> people) {
  Vec2 best = Vec2::Zero();
  for (int x = -10; x <= 10; ++x)
    for (int y = -10; y <= 10; ++y) {
      const Vec2 shift = 0.05 * Vec2(x, y);
      if (standing_cost(object, shift, others, people) < standing_cost(object, best, others, people) - 1e-12) best = shift;
    }
  return best;
}

TEST(SettleObjects, PushesABoxOutOfAWalkedPath) {
  std::vector<Passing> way = walk({-2, 0.13}, {2, 0.13}, 80);
  for (Passing& p : way)
    for (Vec3& joint : p.joints) joint.z() = 0.4;
  std::vector<FoundObject> objects = {found(0, "chair", {0.02, 0}, 1)};
  const double before = standing_cost(objects[0].object, {0, 0}, objects, way);
  settle_objects(objects, way);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_GT(before, 10);
  EXPECT_LT(standing_cost(objects[0].object, {0, 0}, objects, way), 0.1 * before);
  EXPECT_LT(objects[0].object.center().y(), -0.1) << "to the near side of the way";
  EXPECT_NEAR(objects[0].object.center().z(), 0.4, 1e-12);
}

TEST(SettleObjects, EndsWhereASearchOfTheGridEnds) {
  Random random(1);
  int moved = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec2 at(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    std::vector<FoundObject> objects = {found(4, i % 2 ? "chair" : "table", at, 1, random.uniform(-kPi, kPi))};
    const double heading = random.uniform(-kPi, kPi);
    std::vector<Passing> way = walk(-2 * Vec2(std::cos(heading), std::sin(heading)), 2 * Vec2(std::cos(heading), std::sin(heading)), 30);
    for (Passing& p : way) p.joints[0].z() = random.uniform(0.5, 0.9);
    Object expected = objects[0].object;
    for (int round = 0; round < 2; ++round) {
      const Vec2 shift = best_shift(expected, objects, way);
      moved += shift.norm() > 0;
      expected = Placement{{shift.x(), shift.y(), 0}, 0} * expected;
    }
    settle_objects(objects, way);
    EXPECT_NEAR((objects[0].object.center() - expected.center()).norm(), 0, 1e-9) << i;
  }
  EXPECT_GT(moved, 10);
}

TEST(SettleObjects, LeavesWhatIsInNobodysWay) {
  std::vector<FoundObject> objects = {found(0, "chair", {0, 0}, 0.5), found(1, "chair", {0.8, 0}, 0.9), found(2, "table", {0, 1}, 0.7)};
  const std::vector<Passing> sits = {passing({0, 0, 0.6}, {0})};
  settle_objects(objects, sits);
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].object.id, 1) << "the surest first";
  EXPECT_EQ(objects[1].object.id, 2);
  EXPECT_EQ(objects[2].object.center(), Vec3(0, 0, 0.4));
}

TEST(SettleObjects, OfTwoInOnePlaceTheLessSureGoes) {
  std::vector<FoundObject> objects = {found(0, "chair", {0, 0}, 0.6), found(1, "chair", {0.03, 0.02}, 0.8), found(2, "chair", {2, 2}, 0.1)};
  std::vector<Passing> people;  // all around, so that neither can be pushed away
  for (int i = 0; i < 3000; ++i) {
    const double radius = 0.36 + 0.05 * (i % 10), angle = 2.4 * i;
    people.push_back(passing({radius * std::cos(angle), radius * std::sin(angle), 0.4}));
  }
  settle_objects(objects, people);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].object.id, 1);
  EXPECT_EQ(objects[1].object.id, 2);
}

TEST(SettleObjects, TwoThatHaveRoomPart) {
  std::vector<FoundObject> objects = {found(0, "chair", {0, 0}, 0.6), found(1, "chair", {0.1, 0}, 0.8)};
  settle_objects(objects, {});
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_GT((objects[0].object.center() - objects[1].object.center()).norm(), 0.3);
}

TEST(SettleObjects, OfNothingIsNothing) {
  std::vector<FoundObject> none;
  settle_objects(none, walk({-2, 0}, {2, 0}, 10));
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace unseen::interactions
