// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Impacts that nobody sees for long: flights in space tell of them.
#include "collision/tracks/meeting_in_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/pair_scene.h"
#include "collision/tracks/pair_links.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

/// Balls in space whose distances change: perspective bends what is no parabola of the picture then.
Vec3 in_space(int body, double s, double pushed = 1.0) {
  const Vec3 push = pushed * Vec3(-3.0, 0.3, 0.3);
  const Vec3 v = body == 0 ? Vec3(Vec3(2.2, -0.2, -1.6) + (s < 0 ? 0.0 : 1.0) * push) : Vec3(Vec3(-1.1, -0.3, 1.5) - (s < 0 ? 0.0 : 0.75) * push);
  return Vec3(body == 0 ? -0.07 : 0.07, -0.2, 2.5) + s * v + Vec3(0, 4.905 * s * s, 0);
}

Arc arc_in_space(int body, int from, int to, double radius, double impact, Random& random, double pushed = 1.0) {
  Arc arc;
  for (int k = from; k < to; ++k) {
    const Vec3 p = in_space(body, (k - impact) / kFps, pushed);
    Candidate c;
    c.frame = k;
    c.u = k;
    c.pixel = Vec2(640, 360) + kFocal / p.z() * p.head<2>() + 0.15 * Vec2(random.normal(), random.normal());
    c.diameter = 2.0 * radius * kFocal / p.z();
    arc.points.push_back(c);
  }
  return arc;
}

TEST(HiddenImpact, FlightsInSpaceTimeAnImpactThatNobodySeesForLong) {
  Random random(19);
  constexpr double kImpact = 60.0, kNoise = 0.3;
  const double radius[2] = {0.08, 0.06};
  std::array<Arc, 4> arcs;
  for (int i = 0; i < 4; ++i) arcs[static_cast<std::size_t>(i)] = arc_in_space(i % 2, i < 2 ? 10 : 80, i < 2 ? 40 : 110, radius[i % 2], kImpact, random);
  const auto meeting = meet_in_space(pair_shot(radius[0], radius[1]), camera(), {&arcs[0], &arcs[1], &arcs[2], &arcs[3]}, 39.0, 80.0, kNoise, kFps);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->u, kImpact, 0.75);
  EXPECT_LT(meeting->misfit, 1.5);
  EXPECT_LT(meeting->opposed, -0.95);
  EXPECT_NEAR(meeting->least_change, Vec2(-3.0, 0.3).norm() / Vec2(2.2, -0.2).norm(), 0.1);
  for (int body = 0; body < 2; ++body) {
    const Vec3 p = in_space(body, 0.0);
    EXPECT_LT((meeting->pixels[static_cast<std::size_t>(body)] - Vec2(640, 360) - kFocal / p.z() * p.head<2>()).norm(), 2.0);
  }
  const double in_the_picture = common_time(link_of(arcs[0], arcs[2], kNoise), link_of(arcs[1], arcs[3], kNoise), kNoise);
  EXPECT_LT(std::abs(meeting->u - kImpact), 0.6 * std::abs(in_the_picture - kImpact));
}

constexpr double kWander = 8.0;  // px, of silhouettes

/// Flights of two bodies that are hidden from frame 40 to 80, `frames` of each.
std::vector<Arc> hidden_arcs(double pushed, double impact, std::uint64_t seed, int frames) {
  Random random(seed);
  std::vector<Arc> arcs;
  for (int i = 0; i < 4; ++i) {
    arcs.push_back(arc_in_space(i % 2, i < 2 ? 40 - frames : 80, i < 2 ? 40 : 80 + frames, i % 2 == 0 ? 0.08 : 0.06, impact, random, pushed));
    CurveSums sums(arcs.back().begin());
    for (Candidate& c : arcs.back().points) {
      c.colored = true;
      c.color = i % 2 == 0 ? Vec3(200, 60, 40) : Vec3(40, 60, 200);
      sums.add(c.u, c.pixel);
    }
    arcs.back().curve = sums.fit();
  }
  return arcs;
}

std::vector<Collision> collisions_of(const std::vector<Arc>& arcs) { return find_collisions(pair_shot(0.08, 0.06), camera(), {}, arcs, kWander, kFps); }

TEST(HiddenImpact, FlightsInSpaceTellOfAnImpactThatTheNoiseOfSilhouettesHides) {
  const std::vector<Arc> arcs = hidden_arcs(1.0, 60.0, 20, 30);
  const Link link = link_of(arcs[1], arcs[3], kWander);
  EXPECT_FALSE(joint_at(60.0, link.curve_before, link.curve_after, kWander, link.diameter).sudden);
  const std::vector<Collision> found = collisions_of(arcs);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].u, 60.0, 1.5);
  EXPECT_EQ(found[0].a.before % 2, found[0].a.after % 2);
}

TEST(HiddenImpact, FlightsInSpaceDecideWhereParabolasOfThePictureEndFarApart) {
  for (std::uint64_t seed = 20; seed < 24; ++seed) {
    const std::vector<Collision> found = collisions_of(hidden_arcs(1.0, 48.0, seed, 40));
    ASSERT_FALSE(found.empty()) << seed;
    EXPECT_NEAR(found[0].u, 48.0, 1.5) << seed;
  }
}

TEST(HiddenImpact, HardlyAChangeBehindSomethingIsNoCollision) {
  for (const double impact : {48.0, 60.0})
    for (const double pushed : {0.0, 0.03, 0.05})
      for (std::uint64_t seed = 20; seed < 24; ++seed) EXPECT_TRUE(collisions_of(hidden_arcs(pushed, impact, seed, 40)).empty()) << impact << " " << pushed << " " << seed;
}

// What comes nearer fast bends so much that a parabola through the later part of its flight misses the impact by a few pixels too many.
TEST(HiddenImpact, FlightsInSpaceTellOfAnImpactThatAnApproachingBallWasSeenAfterOnlyLater) {
  constexpr double kRate = 60.0, kImpact = 21.0, kNoise = 0.5, kRadius = 0.05;
  const Vec3 before[2] = {{1.9, -1.4, 0.4}, {-1.7, -1.3, -0.6}}, after[2] = {{-1.6, -0.3, -1.0}, {0.6, -2.1, 0.7}};
  Random random(7);
  const auto arc = [&](int body, int from, int to) {
    std::vector<Candidate> points;
    for (int k = from; k < to; ++k) {
      const double s = (k - kImpact) / kRate;
      const Vec3 p = Vec3(body == 0 ? -kRadius : kRadius, -0.1, 2.2) + s * (s < 0 ? before : after)[body] + Vec3(0, 4.905 * s * s, 0);
      Candidate c;
      c.frame = k;
      c.u = k;
      c.pixel = Vec2(640, 360) + kFocal / p.z() * p.head<2>() + 0.3 * Vec2(random.normal(), random.normal());
      c.diameter = 2.0 * kRadius * kFocal / p.z();
      points.push_back(c);
    }
    return arc_of(std::move(points));
  };
  const auto found = find_collisions(pair_shot(kRadius, kRadius), camera(), {}, {arc(0, 0, 21), arc(1, 0, 21), arc(1, 22, 44), arc(0, 29, 50)}, kNoise, kRate);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().u, kImpact, 0.5);
}

}  // namespace
}  // namespace unseen::collision::test
