// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Which flight the sightings next to an impact belong to.
#include <gtest/gtest.h>

#include "collision/two_balls.h"

namespace unseen::collision::test {
namespace {

TEST(Split, SightingsNextToTheImpactFindTheirFlight) {
  for (const double late : {0.04, 0.1, 0.3, 0.9, 0.97})
    for (const int after : {3, 8}) {
      Context context;
      const Reconstruction r = reconstruct(two_balls({late, after}), {}, context);
      ASSERT_TRUE(r.impacts.size() == 1 && r.mass_ratio) << late << " " << after;
      EXPECT_NEAR(r.impacts[0].frame, kMeeting + late, 0.02) << late << " " << after;
      EXPECT_NEAR(r.impacts[0].restitution.value, kRestitution, 0.01) << late << " " << after;
      EXPECT_NEAR(r.mass_ratio->value, kMassRatio, 0.015) << late << " " << after;
    }
}

}  // namespace
}  // namespace unseen::collision::test
