// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/sighted.h"

#include <gtest/gtest.h>

namespace unseen::collision {
namespace {

TEST(SightedIn, NamesWhatFliesAndLeavesShadowsOut) {
  Footage footage;
  for (int f = 0; f < 2; ++f) {
    Region ball, hand, shade;
    ball.centroid = {10.0 + f, 20};
    ball.diameter = 5;
    hand.centroid = {100, 50};
    shade.shadow = true;
    footage.regions.push_back({hand, shade, ball});
  }
  Tracks tracks;
  tracks.points = {{0, 1, 0.1, {11, 20}, 5, 2}};
  tracks.spans = {{0, 0, 1}};
  const std::vector<Sighted> seen = sighted_in(footage, tracks);
  ASSERT_EQ(seen.size(), 4u) << "hand and ball, twice";
  EXPECT_FALSE(seen[0].body || seen[1].body || seen[2].body);
  EXPECT_EQ(seen[3].body, 0);
  EXPECT_EQ(seen[3].frame, 1);
  EXPECT_EQ(seen[3].center, Vec2(11, 20));
}

TEST(SightedIn, KeepsTheLargestFewOfAFrame) {
  Footage footage;
  footage.regions.emplace_back(20);  // by falling size
  for (int i = 0; i < 20; ++i) footage.regions[0][i].diameter = 20 - i;
  const std::vector<Sighted> seen = sighted_in(footage, {});
  ASSERT_EQ(seen.size(), 8u);
  EXPECT_EQ(seen.back().diameter, 13);
}

}  // namespace
}  // namespace unseen::collision
