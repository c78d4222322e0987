// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A ball that flies along the view ray at a wall which the camera faces: the picture's parabolas hardly have a kink there.
#include <gtest/gtest.h>

#include <cmath>

#include "collision/chain.h"
#include "collision/filmed_bounce.h"
#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

constexpr double kC = 0.65, kRadius = 0.06, kFps = 120.0, kImpact = 0.4037, kWall = 4.0;  // s; m, of the ball's centre

/// Closed form, in a camera that looks down by `pitch` (rad): before the impact from 0.8 m on, then back; `c` negative: on through the wall.
Vec3 place(double time, double pitch, double c) {
  const double t = time - kImpact, speed = t < 0.0 || c < 0.0 ? 7.5 : -c * 7.5;
  const Vec3 level(0.2 + 0.4 * t, 0.1 - 0.5 * t + 0.5 * 9.81 * t * t, kWall + speed * t);
  return Eigen::AngleAxisd(pitch, Vec3::UnitX()) * level;
}

Shot thrown_at_wall(double pitch, std::uint64_t seed, double c = kC, bool sized = true) {
  Shot shot = ball_and("wall", kRadius, kFps, 1000);
  Random random(seed);
  for (int frame = 0; frame < 90; ++frame) {
    const Vec3 p = place(frame / kFps, pitch, c);
    const Vec2 pixel = shot.camera.camera.project(p) + 0.3 * Vec2(random.normal(), random.normal());
    const double radius = shot.camera.camera.fx * kRadius / p.z() * std::exp(0.01 * random.normal());
    if (p.z() > 0.5 && pixel.x() > 0 && pixel.x() < 1280 && pixel.y() > 0 && pixel.y() < 720) shot.observations.push_back({frame, pixel, sized ? radius : 0.0, 0});
  }
  return shot;
}

Reconstruction solve(const Shot& shot) {
  Context context;
  return reconstruct(shot, {}, context);
}

TEST(Wall, ThatTheCameraFacesIsFoundAndItsIntervalHolds) {
  int found = 0, held = 0, runs = 0;
  for (const bool sized : {true, false})
    for (const double pitch : {-0.15, 0.0, 0.15})
      for (std::uint64_t seed = 1; seed <= 2; ++seed, ++runs) {
        const Shot shot = thrown_at_wall(pitch, seed, kC, sized);
        ASSERT_GT(shot.observations.size(), 60u);
        const Reconstruction r = solve(shot);
        if (r.impacts.size() != 1 || !r.restitution) continue;
        ++found;
        EXPECT_NEAR(r.impacts[0].time, kImpact, 1.0 / kFps);
        EXPECT_NEAR(r.restitution->value, kC, 0.1);
        held += r.restitution->low <= kC && kC <= r.restitution->high;
      }
  EXPECT_GE(found, runs - 1);
  EXPECT_GE(held, found - 1);
}

TEST(Wall, IsNotSeenWhereABallFliesOn) {
  for (const double pitch : {-0.15, 0.0, 0.15})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) EXPECT_TRUE(solve(thrown_at_wall(pitch, seed, -1.0)).impacts.empty()) << pitch << " " << seed;
}

/// Regions of a film: sizes say where a ball turns.
TEST(Wall, OfAFilmIsFoundByTheSizes) {
  Shot shot = thrown_at_wall(0.0, 1);
  shot.video = "film";
  for (const bool turns : {true, false}) {
    if (!turns) shot.observations = thrown_at_wall(0.0, 1, -1.0).observations;
    Candidates candidates = candidates_of(shot.observations, shot.camera);
    Context context;
    const Tracks tracks = find_chain(shot, shot.camera, candidates, 0, kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), turns ? 1u : 0u);
    if (turns) {
      EXPECT_NEAR(tracks.meetings[0].time, kImpact, 2.0 / kFps);
    }
  }
}

/// Nothing is lost in an elastic impact; noise then has half of all solutions gain energy.
TEST(Elastic, ImpactsGetTheirValue) {
  for (int seed = 1; seed <= 4; ++seed) {
    SynthOptions o;
    o.scene = "planar";
    o.video = false;
    o.restitution = 1.0;
    o.fps = 120;
    o.centroid_noise = 0.02;
    o.seed = seed;
    const Reconstruction r = solve(simulate(o).shot);
    ASSERT_TRUE(r.restitution) << "seed " << seed;
    EXPECT_GE(r.restitution->high, 1.0);
    EXPECT_GT(r.restitution->value, 0.9);
  }
}

}  // namespace
}  // namespace unseen::collision
