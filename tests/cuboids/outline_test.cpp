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

}  // namespace
}  // namespace unseen::cuboids::test
