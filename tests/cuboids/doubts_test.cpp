// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/doubts.h"

#include <gtest/gtest.h>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

/// What is said of boxes in a scene that consists of `things`.
std::vector<std::string> said_of(const std::vector<OrientedBox>& boxes, const std::vector<OrientedBox>& things) {
  Scene scene;
  scene.boxes = things;
  std::vector<Cuboid> cuboids;
  for (const OrientedBox& box : boxes) {
    cuboids.emplace_back();
    cuboids.back().id = static_cast<int>(cuboids.size());
    cuboids.back().box = box;
  }
  Context context;
  warn_of_no_boxes(DepthView(render(scene), camera_of(scene), 0.0015), std::vector<double>(boxes.size(), 0.01), cuboids, context);
  return context.take_warnings();
}

TEST(Doubts, SurfaceWithinABoxIsThatOfSeveralThings) {
  const OrientedBox below = upright(0, 0.9, 0, {0.30, 0.24, 0.15}, 0), above = upright(0, 0.9, 0.15, {0.26, 0.20, 0.15}, 20), all = upright(0, 0.9, 0, {0.32, 0.28, 0.30}, 0);
  EXPECT_EQ(said_of({below, above}, {below, above}), std::vector<std::string>());
  const std::vector<std::string> said = said_of({all, above}, {below, above});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].find("may be several things, no box, or less than its box, as surface was seen within it: box 1 ("), 0u) << said[0];
}

TEST(Doubts, AMostlyFreeBoxIsNamedOnce) {
  const OrientedBox seat = upright(0, 0.9, 0, {0.4, 0.4, 0.1}, 0), back = upright(0, 1.08, 0.1, {0.4, 0.04, 0.3}, 0), all = upright(0, 0.9, 0, {0.4, 0.4, 0.4}, 0);
  const std::vector<std::string> said = said_of({seat, all, back}, {seat, back});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].find("what was seen is no box, and its box holds space that was seen free: box 2 ("), 0u) << said[0];
}

}  // namespace
}  // namespace unseen::cuboids::test
