// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/gather_objects.h"

#include <gtest/gtest.h>

#include "interactions/method_samples.h"
#include "interactions/scenelets_sample.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

View level_view() { return view_of({1000, 1000, 960, 540, 1920, 1080}, {1.4, 0, 0, "given"}); }

Object furniture(Superclass superclass, const Vec2& at) {
  switch (superclass) {
    case Superclass::sit: return box_object(-1, "chair", "seat", {at.x(), at.y(), 0.45}, {0.5, 0.5, 0.1});
    case Superclass::table: return box_object(-1, "table", "top", {at.x(), at.y(), 0.72}, {1.2, 0.7, 0.05});
    default: return box_object(-1, "shelf", "shelf", {at.x(), at.y(), 1.2}, {0.9, 0.3, 0.03});
  }
}

/// Votes for an object from readings `first` to `last` of a story: ten matches each that agree, but for `noise` (m) in each direction.
void vote(std::vector<UsedObject>& votes, Random& random, Superclass superclass, const Vec2& at, int story, std::size_t first, std::size_t last,
          const Vec2& noise, double share = 1, double likelihood = 0.8) {
  for (std::size_t reading = first; reading <= last; ++reading)
    for (int match = 0; match < 10; ++match) {
      const Vec2 place = at + Vec2(noise.x() * random.normal(), noise.y() * random.normal());
      votes.push_back({story, reading, match, furniture(superclass, place), place, 0.02 * share, 0.1 * share, likelihood});
    }
}

TEST(GatherObjects, TwoChairsSideBySideStayTwo) {
  Random random(1);
  std::vector<UsedObject> votes;
  vote(votes, random, Superclass::sit, {-0.4, 4}, 0, 0, 10, {0.05, 0.2});
  vote(votes, random, Superclass::sit, {0.4, 4}, 0, 30, 40, {0.05, 0.2});
  const Gathered gathered = gather_objects(votes, level_view());
  ASSERT_EQ(gathered.objects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const FoundObject& found = gathered.objects[i];
    EXPECT_NEAR(std::abs(found.object.center().x()), 0.4, 0.05);
    EXPECT_NEAR(found.object.center().y(), 4, 0.1);
    EXPECT_EQ(found.object.id, static_cast<int>(i));
    EXPECT_EQ(found.object.category, "chair");
    EXPECT_GT(found.confidence, 0.9);
    EXPECT_LE(found.confidence, 1.0);
    for (const std::size_t m : gathered.members[i]) EXPECT_GT(votes[m].place.x() * found.object.center().x(), 0);
  }
  EXPECT_EQ(gathered.members[0].size() + gathered.members[1].size(), votes.size());
}

TEST(GatherObjects, OneChairSeenFromTwoSitsIsOne) {
  Random random(2);
  std::vector<UsedObject> votes;
  vote(votes, random, Superclass::sit, {0.1, 4.2}, 0, 0, 10, {0.04, 0.1});
  vote(votes, random, Superclass::sit, {0.0, 3.8}, 0, 60, 70, {0.04, 0.1});
  vote(votes, random, Superclass::sit, {0.05, 4.0}, 1, 5, 12, {0.04, 0.1});
  const Gathered gathered = gather_objects(votes, level_view());
  ASSERT_EQ(gathered.objects.size(), 1u);
  EXPECT_NEAR((gathered.objects[0].object.center() - Vec3(0.05, 4, 0.45)).norm(), 0, 0.1);
}

TEST(GatherObjects, ChairAndTableInOnePlaceAreTwo) {
  Random random(3);
  std::vector<UsedObject> votes;
  vote(votes, random, Superclass::sit, {0, 4}, 0, 0, 10, {0.04, 0.1});
  vote(votes, random, Superclass::table, {0, 4.2}, 0, 0, 10, {0.04, 0.1});
  const Gathered gathered = gather_objects(votes, level_view());
  ASSERT_EQ(gathered.objects.size(), 2u);
  EXPECT_NE(gathered.objects[0].object.superclass(), gathered.objects[1].object.superclass());
}

TEST(GatherObjects, TableAndShelfInOnePlaceAreOneOfThem) {
  Random random(6);
  for (const bool shelf : {false, true}) {
    const Superclass is = shelf ? Superclass::shelf : Superclass::table, is_not = shelf ? Superclass::table : Superclass::shelf;
    std::vector<UsedObject> more, fewer;
    vote(more, random, is, {0, 4}, 0, 0, 30, {0.04, 0.1}, 0.6);
    vote(fewer, random, is_not, {0.1, 4.2}, 0, 40, 49, {0.04, 0.1}, 0.9);
    const double surer = std::max(gather_objects(more, level_view()).objects.at(0).confidence, gather_objects(fewer, level_view()).objects.at(0).confidence);
    std::vector<UsedObject> votes = more;
    votes.insert(votes.end(), fewer.begin(), fewer.end());
    const Gathered gathered = gather_objects(votes, level_view());
    ASSERT_EQ(gathered.objects.size(), 1u);
    EXPECT_EQ(gathered.objects[0].object.superclass(), is);
    EXPECT_EQ(gathered.members[0].size(), more.size());
    EXPECT_EQ(gathered.objects[0].confidence, surer);
    vote(votes, random, is_not, {1.2, 4}, 0, 60, 80, {0.04, 0.1});
    EXPECT_EQ(gather_objects(votes, level_view()).objects.size(), 2u) << "side by side they are two";
  }
}

TEST(GatherObjects, ASeatOfWhoHardlyInteractsIsDoubtful) {
  Random random(7);
  std::vector<UsedObject> votes;
  vote(votes, random, Superclass::sit, {0, 4}, 0, 0, 10, {0.04, 0.1}, 1, 0.25);
  EXPECT_NEAR(gather_objects(votes, level_view()).objects.at(0).confidence, 0.5, 0.02);
}

TEST(GatherObjects, WhatIsBrieflyOrRarelyHeldLikelyIsNone) {
  Random random(4);
  std::vector<UsedObject> brief, doubtful, scattered;
  vote(brief, random, Superclass::sit, {0, 4}, 0, 0, 1, {0.04, 0.1});  // 0.4 s
  vote(doubtful, random, Superclass::sit, {0, 4}, 0, 0, 100, {0.04, 0.1}, 0.3);  // 30 % of each reading
  for (std::size_t r = 0; r < 40; r += 2) vote(scattered, random, Superclass::shelf, {random.uniform(-3, 3), random.uniform(2, 9)}, 0, r, r, {0, 0});
  EXPECT_TRUE(gather_objects(brief, level_view()).objects.empty());
  EXPECT_TRUE(gather_objects(doubtful, level_view()).objects.empty());
  EXPECT_TRUE(gather_objects(scattered, level_view()).objects.empty());
  EXPECT_TRUE(gather_objects({}, level_view()).objects.empty());
}

TEST(GatherObjects, StandsOnTheFloorAndIsOfTheCommonerCategory) {
  Random random(5);
  std::vector<UsedObject> votes;
  vote(votes, random, Superclass::sit, {0, 4}, 0, 0, 10, {0.04, 0.1});
  for (std::size_t i = 0; i < votes.size(); i += 4) votes[i].object.category = "stool";
  const Gathered gathered = gather_objects(votes, level_view());
  ASSERT_EQ(gathered.objects.size(), 1u);
  EXPECT_EQ(gathered.objects[0].object.category, "chair");
  EXPECT_NEAR(gathered.objects[0].object.center().z(), 0.45, 1e-12);
}

/// Somebody sits on a chair beside a table for five seconds.
std::vector<Reading> seated_readings() {
  std::vector<Reading> readings;
  for (int i = 0; i < 25; ++i) {
    Reading r;
    r.frame = 2 * i;
    r.matches = {{0, {{0.3, 3.8, 0}, 0.5}, 0.001}, {1, {{0.2, 4.1, 0}, 0.5}, 0.002}};
    r.weights = {0.7, 0.3};
    readings.push_back(r);
  }
  return readings;
}

TEST(UsedObjectsIn, LieOnThePathAsTheMatchTurnsThem) {
  const Object chair = furniture(Superclass::sit, {0, -0.1}), table = furniture(Superclass::table, {0, 0.6});
  const Database database{{}, {test::moving_scenelet(simple_pose(1), 0, {chair, table}), test::moving_scenelet(simple_pose(1), 0, {chair})}};
  const Path path{0, std::vector<Vec2>(50, Vec2(0.25, 4))};
  const auto in_use = used_objects_in(3, seated_readings(), path, database, {{true, true}, {true}});
  ASSERT_EQ(in_use.size(), 75u);
  double mass = 0;
  for (const UsedObject& o : in_use) {
    EXPECT_EQ(o.story, 3);
    const bool seat = o.object.superclass() == Superclass::sit;
    const Vec3 expected = Placement{{0.25, 4, 0}, 0.5} * (seat ? chair : table).center();
    EXPECT_NEAR((o.object.center() - expected).norm(), 0, 1e-9);
    EXPECT_NEAR((o.place - (seat ? Vec2(0.25, 4) : Vec2(expected.head<2>()))).norm(), 0, 1e-9) << "of a seat where it is sat on";
    if (seat) mass += o.mass;
  }
  EXPECT_NEAR(mass, 5, 1e-9) << "s";
}

TEST(UsedObjectsIn, ATableThatMerelyStandsByIsNone) {
  const Object chair = furniture(Superclass::sit, {0, 0}), table = furniture(Superclass::table, {0, 0.6});
  const Scenelet scenelet = test::moving_scenelet(simple_pose(1), 0, {chair, table});
  const Path path{0, std::vector<Vec2>(50, Vec2(0.25, 4))};
  const auto in_use = used_objects_in(0, seated_readings(), path, {{}, {scenelet, scenelet}}, {{true, false}, {true, false}});
  const Gathered gathered = gather_objects(in_use, level_view());
  ASSERT_EQ(gathered.objects.size(), 1u);
  EXPECT_EQ(gathered.objects[0].object.category, "chair");
}

}  // namespace
}  // namespace unseen::interactions
