// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A heavy ball flies on as if nothing had been, where a light one comes back from it.
#include "collision/tracks/heavy_body.h"

#include <gtest/gtest.h>

#include "collision/pair_scene.h"
#include "collision/tracks/tracks.h"
#include "unseen/collision/collision.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

constexpr double kHit = 0.25, kLargeRadius = 0.1, kSmallRadius = 0.02, kBounciness = 0.7;  // s, m

/// Both, as a tracker without labels sees them. `aside`: m that the large one flies nearer to the camera; more than both radii, and they miss.
Shot large_and_small(double mass_ratio, double aside, std::uint64_t seed) {
  Shot shot = pair_shot(kLargeRadius, kSmallRadius);
  shot.fps = kFps;
  shot.camera = camera();
  Random random(seed);
  const Vec3 n = Vec3(0.9, -0.4, 0.1).normalized(), at(0.0, 0.0, 1.8), g(0, 9.81, 0), large(0.7, -0.9, 0.1), small(-1.8, -0.5, 0.0);
  const Vec3 impulse = (1.0 + kBounciness) * n.dot(large - small) * mass_ratio / (1.0 + mass_ratio) * n;
  const auto add = [&](int k, const Vec3& p, double radius) {
    const Vec2 off(random.normal(), random.normal());
    shot.observations.push_back({k, shot.camera.camera.project(p) + 0.3 * off, kFocal * radius / p.z() + 0.2 * random.normal(), -1});
  };
  for (int k = 0; k < 60; ++k) {
    const double t = k / kFps - kHit;
    const bool hit = t > 0.0 && aside == 0.0;
    add(k, at - kLargeRadius * n - Vec3(0, 0, aside) + t * (hit ? Vec3(large - impulse) : large) + 0.5 * t * t * g, kLargeRadius);
    add(k, at + kSmallRadius * n + t * (hit ? Vec3(small + impulse / mass_ratio) : small) + 0.5 * t * t * g, kSmallRadius);
  }
  return shot;
}

TEST(HeavyBody, IsHitByALightOneThoughItsFlightShowsNothing) {
  for (const double mass_ratio : {0.005, 0.01, 0.02})
    for (const std::uint64_t seed : {1, 2, 3}) {
      Context context;
      const Reconstruction r = reconstruct(large_and_small(mass_ratio, 0.0, seed), {}, context);
      ASSERT_EQ(r.impacts.size(), 1u) << mass_ratio << " " << seed;
      EXPECT_NEAR(r.impacts[0].time, kHit, 0.25 / kFps);
      ASSERT_TRUE(r.restitution);
      EXPECT_NEAR(r.restitution->value, kBounciness, 0.1);
      EXPECT_LE(r.restitution->low, kBounciness);
      EXPECT_GE(r.restitution->high, kBounciness);
      ASSERT_TRUE(r.mass_ratio);
      EXPECT_NEAR(r.mass_ratio->value, mass_ratio, 0.01);
    }
}

TEST(HeavyBody, IsNotHitByWhatPassesBehindIt) {
  Context context;
  EXPECT_TRUE(reconstruct(large_and_small(0.01, 0.4, 1), {}, context).impacts.empty());
}

// The light ball is pushed up by a floor below the large one, which passes in front of it.
TEST(HeavyBody, DoesNotPushWhatItPasses) {
  Shot shot = large_and_small(0.01, 0.4, 1);
  const Camera& c = shot.camera.camera;
  for (Sighting& s : shot.observations) {
    if (s.radius > 30.0) continue;
    const double t = s.frame / kFps - kHit, speed = t < 0.0 ? 2.0 : -1.4;
    s.pixel = c.project(Vec3(0.1 - 0.5 * t, 0.1 + speed * t + 0.5 * 9.81 * t * t, 1.9));
  }
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(r.impacts.empty());
}

}  // namespace
}  // namespace unseen::collision::test
