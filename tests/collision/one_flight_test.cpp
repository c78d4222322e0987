// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/one_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/pair_scene.h"
#include "collision/tracks/tracks.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

/// A ball that falls in front of a camera that looks down by `pitch`, and bounces with `c` at 0.4 s (0 = it flies on), from there at `from` s, in pixels.
std::vector<Candidate> seen(double pitch, double c, double from, double to, double noise, std::uint64_t seed) {
  Random random(seed);
  const Mat3 R = Eigen::AngleAxisd(pitch, Vec3::UnitX()).toRotationMatrix();
  std::vector<Candidate> points;
  for (int frame = static_cast<int>(from * kFps); frame < to * kFps; ++frame) {
    const double t = frame / kFps, bounce = 0.4, after = std::max(0.0, t - bounce), g = 9.81;
    const double y = c > 0.0 && after > 0.0 ? 0.5 * g * bounce * bounce - c * g * bounce * after + 0.5 * g * after * after : 0.5 * g * t * t;
    const Vec3 p = R * Vec3(0.3 * t, y - 0.4, 1.6 - 0.2 * t);
    Candidate candidate;
    candidate.frame = frame;
    candidate.u = frame;
    candidate.pixel = Vec2(640, 360) + kFocal / p.z() * p.head<2>() + noise * Vec2(random.normal(), random.normal());
    points.push_back(candidate);
  }
  return points;
}

TEST(OneFlight, IsSeenWhateverTheCamerasPitch) {
  for (const double pitch : {0.0, 0.2, 0.4, 0.6})
    for (const double noise : {0.1, 0.4})
      for (std::uint64_t seed = 1; seed < 6; ++seed) EXPECT_TRUE(is_one_flight(seen(pitch, 0.0, 0.0, 0.5, noise, seed), noise)) << pitch << " " << noise << " " << seed;
}

TEST(OneFlight, ABouncingBallIsOnTwo) {
  for (const double pitch : {0.0, 0.4})
    for (const double c : {0.1, 0.5, 0.9})
      for (std::uint64_t seed = 1; seed < 6; ++seed) {
        EXPECT_FALSE(is_one_flight(seen(pitch, c, 0.0, 0.6, 0.4, seed), 0.4)) << pitch << " " << c << " " << seed;
        EXPECT_FALSE(is_one_flight(seen(pitch, c, 0.3, 0.46, 0.4, seed), 0.4)) << pitch << " " << c << " " << seed;  // a short piece about it
      }
}

// Its fall is no parabola of the picture, and would be cut into several; all of it goes to the bounce.
TEST(OneFlight, OfAFallBeforeACameraThatLooksDownIsWhole) {
  Shot shot;
  shot.name = "shot";
  shot.bodies = {ball("ball", 0.03), {}};
  shot.bodies[1].name = "floor";
  shot.bodies[1].shape = Shape::fixed;
  for (const double pitch : {0.0, 0.3, 0.5}) {
    std::vector<Sighting> sightings;
    for (const Candidate& c : seen(pitch, 0.7, 0.0, 0.85, 0.2, 3)) sightings.push_back({c.frame, c.pixel, 17.0, -1});
    Context context;
    const Tracks tracks = find_tracks(shot, camera(), sightings, kFps, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << pitch;
    EXPECT_NEAR(tracks.meetings[0].time, 0.4, 0.3 / kFps);
    const FlightSpan& before = tracks.spans[static_cast<std::size_t>(tracks.meetings[0].before[0])];
    const FlightSpan& after = tracks.spans[static_cast<std::size_t>(tracks.meetings[0].after[0])];
    EXPECT_GT(before.end - before.begin, 0.4 * kFps - 4.0) << pitch;
    EXPECT_GT(after.end - after.begin, 0.45 * kFps - 4.0) << pitch;
  }
}

TEST(OneFlight, AFewPointsTellNothing) { EXPECT_FALSE(is_one_flight(seen(0.2, 0.0, 0.0, 0.08, 0.1, 1), 0.1)); }

}  // namespace
}  // namespace unseen::collision::test
