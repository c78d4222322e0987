// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Two balls whose sightings tell little of which is nearer to the camera when they meet: the impulse may point into the picture or out of it.
#include <gtest/gtest.h>

#include <cmath>

#include "collision/two_balls.h"

namespace unseen::collision::test {
namespace {

/// Centers alone, 1 px of noise.
Shot centers(double away, std::uint64_t seed) {
  Shot shot = two_balls({.late = 0.4, .after = 28, .from = 4, .fps = 84, .along = {1, 0.2, away}, .noise = 1.0, .seed = seed});
  for (Sighting& s : shot.observations) s.radius = 0;
  return shot;
}

/// The other solution needs friction that speeds up the slide of one ball on the other.
TEST(InFront, FrictionTellsWhichBallIsInFront) {
  for (const double away : {-0.45, -0.3, -0.1})
    for (const std::uint64_t seed : {1, 2, 10}) {
      Context context;
      const Reconstruction r = reconstruct(centers(away, seed), {}, context);
      ASSERT_TRUE(r.restitution) << seed;
      EXPECT_LE(r.restitution->low, kRestitution) << seed;
      EXPECT_GE(r.restitution->high, kRestitution) << seed;
      EXPECT_NEAR(r.restitution->value, kRestitution, 0.05) << seed;
      EXPECT_TRUE(r.ambiguous.empty()) << seed;
    }
}

TEST(InFront, WhereSightingsTellThereIsOneSolution) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Context context;
    EXPECT_TRUE(reconstruct(centers(0.45, seed), {}, context).ambiguous.empty()) << seed;
  }
}

}  // namespace
}  // namespace unseen::collision::test
