// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(Outline, TellsTheTurnOfABoxWhoseSidesAreHidden) {  // by a board before it, which cuts its top off aslant
  for (const double turn : {-8.0, 8.0}) {
    Scene scene;
    scene.boxes = {upright(0, 1.0, 0, {0.3, 0.25, 0.05}, 0), upright(-0.02, 0.72, 0, {0.5, 0.02, 0.2}, turn)};
    const Perceived p = perceive(render(scene));
    EXPECT_LT(turn_between(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 1.5) << turn;
  }
}

TEST(Outline, TellsTheTurnOfAThinBoxThatThePictureCutsOff) {
  for (const double turn : {25.0, 50.0, -30.0})
    for (const double y : {0.31, 0.36}) {
      Scene scene;
      scene.boxes = {upright(0.0, y, 0, {0.16, 0.24, 0.03}, turn), upright(0.1, 0.7, 0, {0.2, 0.15, 0.15}, 10)};
      const Perceived p = perceive(render(scene));
      ASSERT_EQ(p.fitted.size(), 2u) << turn << " " << y;
      EXPECT_LT(turn_between(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 3.0) << turn << " " << y;
    }
}

TEST(Outline, OfWhatLeansSidewaysIsNoWider) {  // a carton that is skewed; a level box around all of it is 11 mm wider
  for (const double lean : {-3.0, 3.0}) {
    Scene scene;
    scene.boxes = {upright(0.02, 0.6, 0, {0.046, 0.137, 0.213}, 0)};
    scene.boxes[0].axes = Eigen::AngleAxisd(radians(lean), Vec3::UnitY()).toRotationMatrix();
    const Perceived p = perceive(render(scene));
    const OrientedBox& box = nearest(p.fitted, scene.boxes[0].center).box;
    EXPECT_NEAR(2.0 * box.half_size.x(), 0.046, 0.005) << lean;
    EXPECT_NEAR(2.0 * box.half_size.z(), 0.213, 0.004) << lean;
    EXPECT_NEAR(box.center.x(), 0.02, 0.003) << lean;
    EXPECT_DOUBLE_EQ(box.axes(2, 2), 1.0) << lean;
  }
}

TEST(Outline, OfWhatIsWiderAboveDoesNotLean) {  // one end upright, the other 7 degrees aslant
  Scene scene;
  scene.boxes = {upright(-0.02, 0.6, 0, {0.08, 0.1, 0.2}, 0), upright(0, 0.6, 0, {0.08, 0.1, 0.2}, 0)};
  scene.boxes[1].axes = Eigen::AngleAxisd(radians(7.0), Vec3::UnitY()).toRotationMatrix();
  const Perceived p = perceive(render(scene));
  const OrientedBox& box = nearest(p.fitted, {0, 0.6, 0.1}).box;
  EXPECT_NEAR(box.center.x() - box.half_size.x(), -0.06, 0.004);
}

/// Few points of its narrow side are seen, and their plane is some degrees off.
TEST(Boxes, ABoardThatLeansHasLevelEdges) {
  for (const double lean : {20.0, 35.0})
    for (const int seed : {1, 2, 3, 4}) {
      Scene scene;
      OrientedBox board = upright(0, 0.9, 0, {0.36, 0.012, 0.3}, -25);
      board.axes = board.axes * Eigen::AngleAxisd(-radians(lean), Vec3::UnitX()).toRotationMatrix();
      board.center.z() = board.axes.row(2).cwiseAbs() * board.half_size;
      scene.boxes = {board};
      const Perceived p = perceive(render(scene, seed));
      ASSERT_EQ(p.fitted.size(), 1u);
      EXPECT_LT(degrees(std::asin(p.fitted[0].box.axes.row(2).cwiseAbs().minCoeff())), 0.6) << lean << " " << seed;
    }
}

}  // namespace
}  // namespace unseen::cuboids::test
