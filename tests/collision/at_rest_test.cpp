// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A ball lies on a tee until another hits it.
#include "collision/tracks/at_rest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "collision/pair_scene.h"
#include "unseen/collision/collision.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

constexpr double kStruckAt = 0.25, kKept = 0.65, kRatio = 0.7, kThrown = 0.05, kTeed = 0.04;  // s, c, m; m

/// `up`: of the push on the ball that lies, which of one that is negative presses it down.
Shot hit_off_a_tee(double up, bool labelled, std::uint64_t seed) {
  Shot shot = pair_shot(kThrown, kTeed);
  shot.fps = kFps;
  shot.camera = camera();
  Random random(seed);
  const Vec3 n = Vec3(1.0, -up, 0.1).normalized(), at(0.1, 0.1, 2.4), g(0, 9.81, 0), thrown(2.2, 0.2, 0.1);
  const Vec3 impulse = (1.0 + kKept) * n.dot(thrown) * kRatio / (1.0 + kRatio) * n;
  for (int k = 0; k < 66; ++k) {
    const double t = k / kFps - kStruckAt;
    const Vec3 fall = 0.5 * t * t * g;
    const Vec3 places[2] = {at - kThrown * n + t * (t > 0.0 ? Vec3(thrown - impulse) : thrown) + fall,
                            t > 0.0 ? Vec3(at + kTeed * n + t / kRatio * impulse + fall) : Vec3(at + kTeed * n)};
    for (int o = 0; o < 2; ++o) {
      const Vec2 off(random.normal(), random.normal());
      const double radius = kFocal * (o == 0 ? kThrown : kTeed) / places[o].z();
      shot.observations.push_back({k, shot.camera.camera.project(places[o]) + 0.3 * off, radius + 0.2 * random.normal(), labelled ? o : -1});
    }
  }
  return shot;
}

TEST(AtRest, ABallOnATeeLiesStillUntilItIsHit) {
  for (const bool labelled : {true, false})
    for (const std::uint64_t seed : {1, 2, 3}) {
      Context context;
      const Reconstruction r = reconstruct(hit_off_a_tee(0.2, labelled, seed), {}, context);
      ASSERT_EQ(r.impacts.size(), 1u) << labelled << seed;
      EXPECT_NEAR(r.impacts[0].time, kStruckAt, 0.25 / kFps);
      EXPECT_TRUE(r.fits);
      ASSERT_TRUE(r.restitution);
      EXPECT_NEAR(r.restitution->value, kKept, 0.04);
      ASSERT_TRUE(r.mass_ratio);
      EXPECT_NEAR(r.mass_ratio->value, kRatio, 0.04);
      EXPECT_TRUE(std::any_of(r.observability.begin(), r.observability.end(), [](const std::string& s) { return s.find("b: it lies still until it is hit") != std::string::npos; }));
      EXPECT_NEAR(r.bodies[1].before.v.norm(), 0.0, 1e-9);
    }
}

TEST(AtRest, WhatIsPressedDownIsSaid) {
  Context context;
  const Reconstruction r = reconstruct(hit_off_a_tee(-0.3, true, 1), {}, context);
  EXPECT_TRUE(std::any_of(r.observability.begin(), r.observability.end(), [](const std::string& s) { return s.find("presses it down") != std::string::npos; }));
}

TEST(AtRest, WhatFliesUpAndDownDoesNotStandStill) {
  std::vector<Vec2> still, flown;
  std::vector<double> times;
  Random random(2);
  for (int k = -10; k <= 10; ++k) {
    times.push_back(0.1 * k);
    const Vec2 noise = 0.5 * Vec2(random.normal(), random.normal());
    still.push_back(noise);
    flown.push_back(Vec2(0, 10.0 * k * k / 100.0) + noise);
  }
  EXPECT_TRUE(stands_still(still, times, 20.0));
  EXPECT_FALSE(stands_still(flown, times, 20.0));
  EXPECT_FALSE(stands_still({still.begin(), still.begin() + 4}, {times.begin(), times.begin() + 4}, 20.0));
  EXPECT_FALSE(stands_still(still, times, 6.0));  // it would not have fallen far
  still.front() = {-20.0, 0.0};                   // seen once long before, elsewhere
  for (double& t : times) t = t == times.front() ? t : 0.9 + 0.1 * t;
  EXPECT_FALSE(stands_still(still, times, 20.0));
}

/// Bodies that are seen for 0.4 s, 2 m before a camera whose picture they do not move in: `down` in its coordinates; `falling`: along the view.
Problem seen_at_one_place(const Vec3& down, bool falling, int bodies) {
  Problem problem;
  problem.camera = camera().camera;
  problem.down = down.normalized();
  for (int body = 0; body < bodies; ++body)
    for (int k = 0; k < 24; ++k) {
      PointObservation p;
      p.body = body;
      p.time = k / 60.0;
      p.pixel = problem.camera.project({0.2 * body, 0, 2}) + Vec2(0.5 * (k % 2), 0.0);
      p.depth = 2.0 + (falling ? 0.5 * 9.81 * p.time * p.time : 0.0);
      problem.points.push_back(p);
    }
  return problem;
}

TEST(AtRest, IsNotWhatFallsAlongTheViewNorBothBodies) {
  EXPECT_TRUE(at_rest(seen_at_one_place({0, 1, 0}, false, 1))[0]);
  EXPECT_FALSE(at_rest(seen_at_one_place({0, 1, 0}, true, 1))[0]);
  EXPECT_FALSE(at_rest(seen_at_one_place({0, 0.01, 1}, false, 1))[0]);
  EXPECT_EQ(at_rest(seen_at_one_place({0, 1, 0}, false, 2)), (std::array<bool, 2>{false, false}));
}

}  // namespace
}  // namespace unseen::collision::test
