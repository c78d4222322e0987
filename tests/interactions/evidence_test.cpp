// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/evidence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "interactions/scenelets_sample.h"
#include "unseen/interactions/evidence_picture.h"

namespace unseen::interactions {
namespace {

/// A chair whose seat is at `at` and which looks along `yaw` (0 = +y).
Object chair(const Vec2& at, double yaw) {
  Object object = box_object(0, "chair", "seat", Vec3(0, 0, 0.45), Vec3(0.5, 0.5, 0.05));
  object.parts.push_back(box_object(0, "", "back", Vec3(0, -0.22, 0.7), Vec3(0.5, 0.05, 0.4)).parts[0]);
  return Placement{Vec3(at.x(), at.y(), 0), yaw} * object;
}

double at(const EvidenceMap& map, Superclass superclass, int turn, const Vec2& p) {
  const Vec2 cell = ((p - map.origin) / map.cell).array().floor();
  return map.probability[((static_cast<std::size_t>(superclass) * EvidenceMap::kTurns + static_cast<std::size_t>(turn)) * static_cast<std::size_t>(map.rows) + static_cast<std::size_t>(cell.y())) * static_cast<std::size_t>(map.columns) +
                         static_cast<std::size_t>(cell.x())];
}

TEST(Evidence, IsTheShareOfTheVotes) {
  std::vector<Evidence> votes;
  for (int moment = 0; moment < 5; ++moment) {
    votes.push_back({moment, 3, {chair(Vec2(1, 2), 0)}});
    votes.push_back({moment, 1, {}});  // this one says that there is nothing
  }
  const std::vector<Vec2> walked = {Vec2(0, 0)};
  const EvidenceMap map = gather(votes, walked, 5);
  EXPECT_NEAR(at(map, Superclass::sit, 0, Vec2(1, 2)), 0.75, 1e-6);
  EXPECT_EQ(at(map, Superclass::sit, 8, Vec2(1, 2)), 0);
  EXPECT_EQ(at(map, Superclass::table, 0, Vec2(1, 2)), 0);
  EXPECT_EQ(at(map, Superclass::sit, 0, Vec2(1.6, 2)), 0);
  EXPECT_NEAR(at(gather(votes, walked, 10), Superclass::sit, 0, Vec2(1, 2)), 0.375, 1e-6);  // of ten moments five said nothing
}

TEST(Evidence, DoesNotGrowWithTheLengthOfAStay) {
  std::vector<Evidence> votes;
  for (int moment = 0; moment < 200; ++moment) votes.push_back({moment, 1, moment % 2 ? std::vector<Object>{chair(Vec2(0, 1), 0)} : std::vector<Object>{chair(Vec2(0, 3), 0)}});
  for (int moment = 0; moment < 200; ++moment) votes.push_back({moment, 1, {}});
  EXPECT_NEAR(at(gather(votes, std::vector<Vec2>{Vec2(0, 0)}, 10), Superclass::sit, 0, Vec2(0, 1)), 0.5, 1e-6);
}

TEST(Evidence, TurnsWithTheObject) {
  for (int turn = 0; turn < EvidenceMap::kTurns; ++turn) {
    const std::vector<Evidence> votes = {{0, 1, {chair(Vec2(1, 1), 2 * kPi * turn / EvidenceMap::kTurns + 0.1)}}};
    EXPECT_EQ(at(gather(votes, std::vector<Vec2>{Vec2(0, 0)}, 1), Superclass::sit, turn, Vec2(1, 1)), 1);
  }
  const std::vector<Evidence> table = {{0, 1, {box_object(0, "table", "top", Vec3(1, 1, 0.7), Vec3(1.6, 0.8, 0.05))}}};
  const EvidenceMap map = gather(table, std::vector<Vec2>{Vec2(0, 0)}, 1);
  for (int turn = 0; turn < EvidenceMap::kTurns; ++turn) EXPECT_EQ(at(map, Superclass::table, turn, Vec2(1, 1)), turn % 8 == 0);
}

TEST(Evidence, NothingStandsWherePeopleWalk) {
  const std::vector<Evidence> votes = {{0, 1, {box_object(0, "table", "top", Vec3(1, 0, 0.7), Vec3(2, 1, 0.05))}}};
  std::vector<Vec2> walked;
  for (int i = 0; i <= 20; ++i) walked.emplace_back(0.1 * i, 0);
  const EvidenceMap map = gather(votes, walked, 1);
  EXPECT_LT(at(map, Superclass::table, 0, Vec2(1.05, 0.05)), 0.3);
  EXPECT_EQ(at(map, Superclass::table, 0, Vec2(1.05, 0.35)), 1);
}

TEST(Evidence, OfNothingIsAnEmptyMap) {
  EXPECT_TRUE(gather({}, {}, 1).probability.empty());
  EXPECT_EQ(picture_of({}, 4).pixels.size(), 0u);
  EvidenceMap geometry;
  geometry.columns = geometry.rows = 5;
  EXPECT_EQ(picture_of(geometry, 4).pixels.size(), 0u);
  const EvidenceMap far = gather(std::vector<Evidence>{{0, 1, {chair(Vec2(1e6, 0), 0)}}}, std::vector<Vec2>{Vec2(0, 0)}, 1);
  EXPECT_EQ(*std::max_element(far.probability.begin(), far.probability.end()), 0);
}

TEST(Evidence, APictureShowsWhatStandsWhere) {
  const std::vector<Evidence> votes = {{0, 1, {chair(Vec2(-1, 1), 0), box_object(1, "shelf", "shelf", Vec3(1, -1, 1), Vec3(0.9, 0.4, 0.03))}}};
  const EvidenceMap map = gather(votes, std::vector<Vec2>{Vec2(0, 0)}, 1);
  const EvidencePicture picture = picture_of(map, 3);
  ASSERT_EQ(picture.width, 3 * map.columns);
  ASSERT_EQ(picture.height, 3 * map.rows);
  const auto pixel = [&](const Vec2& p) {
    const Vec2 q = (p - map.origin) / map.cell * 3;
    return picture.pixels[static_cast<std::size_t>(picture.height - 1 - static_cast<int>(q.y())) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(q.x())];
  };
  EXPECT_EQ(pixel(Vec2(-1, 1)), (std::array<std::uint8_t, 3>{0, 114, 178}));
  EXPECT_EQ(pixel(Vec2(1, -1)), (std::array<std::uint8_t, 3>{0, 158, 115}));
  EXPECT_EQ(pixel(Vec2(1, 1)), (std::array<std::uint8_t, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace unseen::interactions
