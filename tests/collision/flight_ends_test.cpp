// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What lies beside a flight and is none of it: outlines of both bodies as one, and a body that is held.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "collision/pair_scene.h"
#include "collision/tracks/arcs.h"
#include "collision/tracks/chain.h"
#include "collision/tracks/pair_links.h"
#include "collision/tracks/tracks.h"
#include "collision/tracks/two_body.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

constexpr double kMetre = 400.0, kGravity = 9.81 * kMetre / (kFps * kFps);  // px; px per frame²
constexpr int kImpact = 40, kParted = 54, kFrames = 90;                       // frames

struct Mover {
  Vec2 place, before, after;  // px at the impact, px a frame
  double diameter;            // px

  Vec2 at(int frame) const {
    const double t = frame - kImpact;
    return place + t * (t < 0.0 ? before : after) + Vec2(0.0, 0.5 * kGravity * t * t);
  }
  double area() const { return 0.25 * kPi * diameter * diameter; }
};

/// Of two of a colour each that hardly part again.
const Mover kRedBall = {{465, 98}, {7.0, -2.4}, {-1.4, -2.0}, 42.0}, kBlueBall = {{510, 100}, {-5.7, -2.2}, {-0.2, -1.2}, 46.0};

const Mover kLarge = {{600, 300}, {4.0, -3.0}, {-1.5, -3.0}, 100.0}, kSmall = {{668, 310}, {-5.0, -2.0}, {1.5, -1.0}, 46.0};

Candidate outline(int frame, int region, const Vec2& place, double diameter, const Vec3& color, Random& random) {
  Candidate c;
  c.frame = frame;
  c.u = frame;
  c.pixel = place + 0.2 * Vec2(random.normal(), random.normal());
  c.diameter = diameter;
  c.area = 0.25 * kPi * diameter * diameter;
  c.colored = true;
  c.color = color;
  c.region = region;
  return c;
}

/// Outlines of the two, one from shortly before the impact until they are apart again.
Candidates merging(std::uint64_t seed) {
  Random random(seed);
  Candidates candidates(kFrames);
  for (int k = 0; k < kFrames; ++k) {
    if (k > kImpact - 3 && k < kParted) {
      const double a = kLarge.area(), b = kSmall.area();
      candidates[k] = {outline(k, 0, (a * kLarge.at(k) + b * kSmall.at(k)) / (a + b), 104.0, {105, 75, 60}, random)};
    } else {
      candidates[k] = {outline(k, 0, kLarge.at(k), kLarge.diameter, {100, 70, 50}, random), outline(k, 1, kSmall.at(k), kSmall.diameter, {150, 140, 170}, random)};
    }
  }
  return candidates;
}

// On its way the blue one meets the outline of both, and there the red one where that comes out again.
TEST(FlightEnds, AnOutlineOfBothDoesNotLeadFromOneBodyToTheOther) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Candidates candidates(kFrames);
    for (int k = 0; k < kFrames; ++k) {
      if (k >= kImpact && k < kImpact + 8) candidates[k] = {outline(k, 0, 0.5 * (kRedBall.at(k) + kBlueBall.at(k)), 60.0, {99, 66, 101}, random)};
      else candidates[k] = {outline(k, 0, kBlueBall.at(k), kBlueBall.diameter, {57, 73, 140}, random), outline(k, 1, kRedBall.at(k), kRedBall.diameter, {147, 54, 53}, random)};
    }
    Context context;
    const Tracks tracks = find_pair(pair_shot(0.055, 0.06), camera(), candidates, kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << seed;
    EXPECT_NEAR(tracks.meetings[0].time * kFps, kImpact, 0.5) << seed;
    ASSERT_EQ(tracks.spans.size(), 4u) << seed;
    for (const FlightSpan& span : tracks.spans) {
      const Mover& mover = tracks.points[span.begin].region == 0 ? kBlueBall : kRedBall;
      for (std::size_t i = span.begin; i < span.end; ++i) EXPECT_LT((tracks.points[i].pixel - mover.at(tracks.points[i].frame)).norm(), 2.0) << seed << ", frame " << tracks.points[i].frame;
      for (const FlightSpan& other : tracks.spans) {
        if (other.body != span.body) continue;
        EXPECT_EQ(tracks.points[other.begin].region, tracks.points[span.begin].region) << seed;
      }
    }
  }
}

TEST(FlightEnds, OutlinesOfBothBodiesAsOneAreOfNoFlight) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Context context;
    const Tracks tracks = find_pair(pair_shot(0.125, 0.058), camera(), merging(seed), kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << seed;
    EXPECT_NEAR(tracks.meetings[0].time * kFps, kImpact, 0.5) << seed;
    for (const FlightSpan& span : tracks.spans) {
      EXPECT_GE(span.end - span.begin, 30u) << seed;
      for (std::size_t i = span.begin; i < span.end; ++i)
        EXPECT_LT((tracks.points[i].pixel - (span.body == 0 ? kLarge : kSmall).at(tracks.points[i].frame)).norm(), 2.0) << seed << ", frame " << tracks.points[i].frame;
    }
  }
}

TEST(FlightEnds, AnOutlineBesideAnotherOrFarFromItIsOfOne) {
  const Candidates candidates = merging(1);
  std::vector<Candidate> before, after;
  for (int k = 0; k < kFrames; ++k)
    if (candidates[k].size() == 2) (k < kImpact ? before : after).push_back(candidates[k][1]);
  const Link small = link_of({before, {}, 0.0}, {after, {}, 0.0}, 0.5);
  EXPECT_TRUE(is_both(candidates[45][0], small, candidates));
  EXPECT_FALSE(is_both(candidates[60][0], small, candidates));  // the small one is seen
  Candidate far = candidates[45][0];
  far.pixel.x() -= 200.0;
  EXPECT_FALSE(is_both(far, small, candidates));
  Candidates parted = candidates;  // by another outline where the small one should be
  Random random(1);
  parted[45].push_back(outline(45, 1, kSmall.at(45), kSmall.diameter, {150, 140, 170}, random));
  EXPECT_FALSE(is_both(parted[45][0], small, parted));
  Candidate told = candidates[45][0];
  told.region = -1;  // a sighting that somebody gives is of one body
  EXPECT_FALSE(is_both(told, small, candidates));
}

/// A ball that is lost soon, and something much like it that flies on as the ball would have by chance.
Candidates led_on(int seen_first, std::uint64_t seed) {
  constexpr int kLost = 40, kPasses = 44;
  Random random(seed);
  Candidates candidates(kFrames);
  for (int k = seen_first; k < kFrames; ++k) {
    const double t = k - kPasses;
    const Vec2 ball(640.0 + 6.0 * t, 260.0 - 2.0 * t + 0.5 * kGravity * t * t), other = ball - Vec2(1.3, 0.75) * t;
    if (k < kLost) candidates[k].push_back(outline(k, 0, ball, 40.0, {150, 90, 60}, random));
    if (k >= kLost + 2) candidates[k].push_back(outline(k, 1, other, 42.0, {148, 92, 58}, random));
  }
  return candidates;
}

TEST(FlightEnds, WhatFliesOnWhereABallWouldHaveIsNotTheBall) {
  for (const int seen_first : {16, 20, 24})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Context context;
      std::array<std::size_t, 2> longest = {0, 0};
      for (const Arc& arc : find_arcs(led_on(seen_first, seed), 2.0, 0.5, context)) {
        const int region = arc.points.front().region;
        for (const Candidate& c : arc.points) EXPECT_EQ(c.region, region) << "seed " << seed << ", from " << seen_first << ", frame " << c.frame;
        longest[region] = std::max(longest[region], arc.points.size());
      }
      EXPECT_GE(longest[0], 38u - seen_first) << "seed " << seed << ", from " << seen_first;
      EXPECT_GE(longest[1], 46u) << "seed " << seed << ", from " << seen_first;
    }
}

// After the impact one passes behind the other, which is where both would be then.
TEST(FlightEnds, ARegionIsOfOneBody) {
  const Mover behind = {kRedBall.place, kRedBall.before, {0.4, -2.0}, 42.0}, front = {kBlueBall.place, kBlueBall.before, {-1.4, -2.08}, 42.0};
  const Vec3 color = {147, 54, 53};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Candidates candidates(kFrames);
    for (int k = 0; k < kFrames; ++k) {
      candidates[k] = {outline(k, 0, front.at(k), front.diameter, color, random)};
      if (k < kImpact || (behind.at(k) - front.at(k)).norm() > 20.0) candidates[k].push_back(outline(k, 1, behind.at(k), behind.diameter, color, random));
    }
    Context context;
    const Tracks tracks = find_pair(pair_shot(0.055, 0.06), camera(), candidates, kFps, 0.5, context);
    std::map<std::pair<int, int>, int> body_of;
    for (const FlightSpan& span : tracks.spans)
      for (std::size_t i = span.begin; i < span.end; ++i) {
        const TrackPoint& p = tracks.points[i];
        EXPECT_EQ(body_of.emplace(std::pair(p.frame, p.region), span.body).first->second, span.body) << "seed " << seed << ", frame " << p.frame;
      }
  }
}

Shot film_of_a_bounce() {
  Shot shot;
  shot.name = "shot";
  shot.video = "film";
  shot.bodies = {ball("ball", 0.03), {}};
  shot.bodies[1].name = "floor";
  shot.bodies[1].shape = Shape::fixed;
  return shot;
}

// A quarter of what a ball falls in four frames is less than the noise that its outline may have at most.
TEST(FlightEnds, FramesInWhichABallIsHeldAreOfNoFlight) {
  constexpr int kDropped = 30;
  const Shot shot = film_of_a_bounce();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    Candidates candidates(120);
    for (int k = 0; k < 120; ++k) {
      const double falls = std::min(std::max(0.0, k - kDropped - 0.4), 40.0), rises = std::max(0.0, k - kDropped - 40.4);
      const double y = 0.5 * kGravity * falls * falls - 0.75 * kGravity * 40.0 * rises + 0.5 * kGravity * rises * rises;
      candidates[k] = {outline(k, 0, {640.0, 100.0 + y}, 24.0, {200, 90, 40}, random)};
    }
    Context context;
    const Tracks tracks = find_chain(shot, camera(), candidates, 0, kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << seed;
    EXPECT_GE(tracks.points.front().frame, kDropped - 2) << seed;
    EXPECT_LE(tracks.points.front().frame, kDropped + 4) << seed;
    EXPECT_EQ(tracks.points.back().frame, 119) << seed;
  }
}

// It is in the picture for longer, and as much of a disc.
TEST(FlightEnds, ABallThatRollsByIsNotTheOneThatFlies) {
  const Shot shot = film_of_a_bounce();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    Candidates candidates(120);
    for (int k = 0; k < 120; ++k) {
      candidates[k] = {outline(k, 0, {100.0 + 8.0 * k, 420.0}, 60.0, {40, 60, 140}, random)};
      const double falls = std::min(static_cast<double>(k), 40.4), rises = std::max(0.0, k - 40.4);
      const double y = 0.5 * kGravity * falls * falls - 0.75 * kGravity * 40.4 * rises + 0.5 * kGravity * rises * rises;
      if (k < 90) candidates[k].push_back(outline(k, 1, {640.0 + k, 80.0 + y}, 24.0, {200, 90, 40}, random));
    }
    Context context;
    const Tracks tracks = find_chain(shot, camera(), candidates, 0, kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << seed;
    EXPECT_NEAR(tracks.meetings[0].time * kFps, 40.4, 0.2) << seed;
    for (const TrackPoint& p : tracks.points) EXPECT_EQ(p.region, 1) << seed;
  }
}

}  // namespace
}  // namespace unseen::collision::test
