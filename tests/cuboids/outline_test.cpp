// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The turn of a low box is told by the ends of its top rather than by its narrow sides.
#include <gtest/gtest.h>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(Outline, TellsTheTurnOfLowBoxes) {
  double sum = 0;
  for (const double yaw : {-30.0, -10.0, 5.0, 20.0, 40.0}) {
    Scene scene;
    scene.boxes = {upright(0, 0.9, 0, {0.3, 0.2, 0.04}, yaw)};
    const Perceived p = perceive(render(scene));
    ASSERT_EQ(p.fitted.size(), 1u);
    sum += turn_between(p.fitted[0].box, scene.boxes[0]);
  }
  EXPECT_LT(sum / 5.0, 0.5);
}

TEST(Outline, DoesNotFollowWhatHidesTheEdge) {  // an upright board before the box cuts its top off aslant
  Scene scene;
  scene.boxes = {upright(0, 1.0, 0, {0.3, 0.25, 0.05}, 0), upright(-0.02, 0.72, 0, {0.5, 0.02, 0.2}, 8)};
  const Perceived p = perceive(render(scene));
  EXPECT_LT(turn_between(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 1.5);
}

}  // namespace
}  // namespace unseen::cuboids::test
