// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Sizes and gravity that tell of different scales: it is said, and counts in the intervals.
#include <gtest/gtest.h>

#include <algorithm>

#include "collision/doubts/scale_doubt.h"
#include "collision/shot_problem.h"
#include "collision/solve_impacts.h"
#include "collision/tracks/tracks.h"
#include "collision/two_balls.h"

namespace unseen::collision::test {
namespace {

Reconstruction solved(const Shot& shot) {
  Context context;
  return reconstruct(shot, {}, context);
}

bool holds(const std::optional<Estimate>& e, double truth) { return e && e->low <= truth && truth <= e->high; }

bool warns(const Reconstruction& r) {
  return std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [](const std::string& w) { return w.find("the distance by its size") != std::string::npos; });
}

/// An impact more along the view than across, where the sizes tell how the balls touch.
Shot shot(std::uint64_t seed) { return two_balls({0.4, 30, 0, 120, {0.5, 0.3, 0.8}, 0.5, seed}); }

TEST(ScaleDoubt, OfSizesOrAFrameRateThatAreWrongIsCounted) {
  int runs = 0, held = 0, ratios = 0, warned = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const int wrong : {1, 2, 3, 4}) {  // bits: which radius is 25 % too large; 4: the frame rate is 10 % too high
      Shot s = shot(seed);
      for (int o = 0; o < 2; ++o)
        if (wrong & (1 << o)) s.bodies[static_cast<std::size_t>(o)].radius *= 1.25;
      if (wrong == 4) *s.fps *= 1.1;
      const Reconstruction r = solved(s);
      ASSERT_EQ(r.impacts.size(), 1u);
      ++runs;
      warned += warns(r);
      held += holds(r.impacts[0].restitution, kRestitution);
      ratios += !r.mass_ratio || holds(r.mass_ratio, kMassRatio);
    }
  EXPECT_EQ(warned, runs);
  EXPECT_GE(held, runs - 1);
  EXPECT_GE(ratios, runs - 1);
}

TEST(ScaleDoubt, OfRightSizesIsNone) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) EXPECT_FALSE(warns(solved(shot(seed)))) << seed;
}

/// Each ball given the other's size: what gravity says of how far away each is tells that, whatever the frame rate; sizes that hardly differ do not.
TEST(ScaleDoubt, TellsBallsThatWereTakenForEachOther) {
  const auto exchanged = [](double other, double rate, bool swapped, std::uint64_t seed) {
    Shot s = two_balls({0.4, 40, -10, 120, {1.0, 0.2, 0.3}, 0.3, seed});
    for (Sighting& seen : s.observations)
      if (seen.body == 0) seen.radius *= other;
    s.bodies[swapped ? 1 : 0].radius *= other;
    *s.fps *= rate;
    Context context;
    const ShotCamera camera = complete_camera(s, 1280, 720);
    Tracks tracks = find_tracks(s, camera, s.observations, *s.fps, context);
    const std::vector<SolvedImpact> impacts = solve_positions(s, {}, camera, {solid_of(s.bodies[0], ""), solid_of(s.bodies[1], "")}, tracks, *s.fps, context);
    EXPECT_EQ(impacts.size(), 1u);
    return !impacts.empty() && look_exchanged(impacts.front().solution);
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const double other : {0.9, 1.1})
      for (const double rate : {0.95, 1.0, 1.05}) {
        EXPECT_TRUE(exchanged(other, rate, true, seed)) << other << " " << rate << " " << seed;
        EXPECT_FALSE(exchanged(other, rate, false, seed)) << other << " " << rate << " " << seed;
      }
  EXPECT_FALSE(exchanged(1.02, 1.0, true, 1));
}

}  // namespace
}  // namespace unseen::collision::test
