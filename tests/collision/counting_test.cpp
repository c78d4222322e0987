// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Frames are counted by what was seen.
#include "collision/tracks/counting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/tracks/flight_cost.h"
#include "collision/tracks/tracks.h"
#include "collision/two_balls.h"

namespace unseen::collision::test {
namespace {

/// Two balls that were seen in one of `apart` frames, or a frame sooner or later.
Shot seen_far_apart(int apart, bool even, bool labelled, std::uint64_t seed) {
  Meeting meeting{0.4, 25, 2, 60};
  meeting.noise = 0.0;
  Shot shot = two_balls(meeting);
  Random random(seed);
  *shot.fps *= apart;
  for (Sighting& s : shot.observations) {
    s.frame *= apart;
    if (!labelled) s.body = -1, s.radius = 0.0;
    s.pixel += 0.5 * Vec2(random.normal(), random.normal());
  }
  if (!even) std::erase_if(shot.observations, [apart](const Sighting& s) { return s.frame % (7 * apart) == 0; });
  return shot;
}

TEST(Counting, SightingsFarApartInFramesAreFollowed) {
  for (const int apart : {3, 5, 7, 16})
    for (const bool labelled : {true, false})
      for (const bool even : {true, false}) {
        Shot shot = seen_far_apart(apart, even, labelled, 3);
        Context context;
        const Tracks tracks = find_tracks(shot, shot.camera, shot.observations, *shot.fps, context);
        ASSERT_EQ(tracks.meetings.size(), 1u) << apart << labelled << even;
        EXPECT_NEAR(tracks.meetings[0].time, (kMeeting + 0.4) / 60, 0.006) << apart << labelled << even;
        for (const TrackPoint& p : tracks.points) EXPECT_NEAR(p.time, p.frame / *shot.fps, 1e-9);
        if (apart == 16) continue;
        EXPECT_NEAR(tracks.noise, 0.5, 0.25);
      }
}

TEST(Counting, EachFrameCountsWhereMostAreSeen) {
  Candidates candidates(30);
  for (int k = 0; k < 30; ++k) {
    Candidate c;
    c.frame = k;
    c.u = k;
    if (k % 5 != 3) candidates[static_cast<std::size_t>(k)].push_back(c);
  }
  EXPECT_EQ(by_sightings(candidates, 60).rate, 60);
  EXPECT_EQ(by_sightings(candidates, 60).candidates.size(), 30u);
}

TEST(Counting, RepeatsOfAConversionAreNoFrames) {
  Candidates candidates(10);
  std::vector<double> times;
  for (int k = 0; k < 10; ++k) {
    Candidate c;
    c.frame = k;
    times.push_back((2 * (k / 5) + (k % 5 >= 2 ? 1 : 0)) / 24.0);
    c.u = times.back() * 60;
    candidates[static_cast<std::size_t>(k)].push_back(c);
  }
  const Counted counted = without_repeats(candidates, times, 60);
  EXPECT_NEAR(counted.rate, 24, 1e-9);
  ASSERT_EQ(counted.candidates.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    const Candidate& c = counted.candidates[static_cast<std::size_t>(k)].front();
    EXPECT_EQ(c.frame, k);
    EXPECT_NEAR(c.u, k, 1e-9);
    EXPECT_EQ(c.file_frame(), 5 * (k / 2) + 2 * (k % 2));
  }
}

// Noise by third differences, also of what is spaced unevenly.
TEST(Counting, NoiseOfUnevenSightings) {
  Random random(4);
  std::vector<Candidate> seen;
  for (int k = 0; k < 400; ++k) {
    Candidate c;
    c.frame = k;
    c.u = k + (k % 2 ? 0.4 : 0.0);
    c.pixel = Vec2(3 * c.u, 0.01 * c.u * c.u) + 0.7 * Vec2(random.normal(), random.normal());
    seen.push_back(c);
  }
  EXPECT_NEAR(sighting_noise({seen}, 0.1), 0.7, 0.1);
}

// Of sightings of which every sixth is simply wrong, the noise is that of the others, and none of them counts as used.
TEST(Counting, SightingsThatAreSimplyWrongAreNotUsed) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Meeting meeting{0.4, 25, 2, 60};
    meeting.along = Vec3(1, 0.2, 0.1);
    Shot shot = two_balls(meeting);
    Random random(seed);
    for (Sighting& s : shot.observations) {
      s.pixel += 0.4 * Vec2(random.normal(), random.normal());
      const double angle = random.uniform(0.0, 2.0 * kPi), far = random.uniform(60.0, 200.0);
      if (random.uniform() < 0.18) s.pixel += far * Vec2(std::cos(angle), std::sin(angle));
    }
    Context context;
    const Reconstruction r = reconstruct(shot, {}, context);
    ASSERT_FALSE(r.residuals.empty());
    for (const Residual& residual : r.residuals) EXPECT_FALSE(residual.used && (residual.seen - residual.predicted).norm() > 50.0) << residual.frame;
    ASSERT_TRUE(r.restitution);
    EXPECT_LE(r.restitution->low, kRestitution);
    EXPECT_GE(r.restitution->high, kRestitution);
  }
}

}  // namespace
}  // namespace unseen::collision::test
