// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/skeleton.h"

#include <gtest/gtest.h>

#include "unseen/core/random.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {
namespace {

Pose standing() {
  Pose p = Pose::Zero();
  p.col(right_hip) = Vec3(0.1, 0, 0.9);
  p.col(left_hip) = Vec3(-0.1, 0, 0.9);
  p.col(right_shoulder) = Vec3(0.2, 0, 1.4);
  p.col(left_shoulder) = Vec3(-0.2, 0, 1.4);
  p.col(pelvis) = Vec3(0, 0, 0.95);
  return p;
}

TEST(Skeleton, FacesForwardWithTheRightHipOnTheRight) { EXPECT_NEAR((facing(standing()) - Vec3::UnitY()).norm(), 0, 1e-12); }

TEST(Skeleton, TheFrameOfAPlacedPoseIsItsPlacement) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Placement placement = {{random.uniform(-3, 3), random.uniform(-3, 3), 0}, random.uniform(-3, 3)};
    const Placement found = frame_of(placement * standing());
    EXPECT_NEAR((found.position - placement.position).norm(), 0, 1e-12);
    EXPECT_NEAR(std::remainder(found.angle - placement.angle, 2 * kPi), 0, 1e-12);
    EXPECT_NEAR((found.inverse() * (placement * standing()) - standing()).norm(), 0, 1e-12);
  }
}

TEST(Objects, TheirMainPartsSayWhereTheyAre) {
  Object chair{0, "chair", {{"seat", {Vec3(1, 2, 0.4)}}, {"back", {Vec3(1, 3, 0.8)}}, {"leg-1", {Vec3(0, 0, 0.2)}}}};
  EXPECT_NEAR((chair.center() - Vec3(1, 2, 0.4)).norm(), 0, 1e-12);
  EXPECT_EQ(chair.superclass(), Superclass::sit);
  EXPECT_EQ(superclass_of("piano"), Superclass::other);
}

}  // namespace
}  // namespace unseen::interactions
