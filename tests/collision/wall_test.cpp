// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A ball that flies along the view ray at a wall which the camera faces: the picture's parabolas hardly have a kink there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/filmed_bounce.h"
#include "collision/tracks/chain.h"
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

constexpr double kFloor = 0.6, kFloorC = 0.5;  // m below the camera's centre, of the ball's; what it lands on is softer

/// The same in a level camera, until the ball has landed on the floor and risen again.
Vec3 place_and_landing(double time) {
  const Vec3 at_wall = place(kImpact, 0.0, kC);
  const double fall = 0.5 * 9.81, v = -0.5, down = (-v + std::sqrt(v * v + 4.0 * fall * (kFloor - at_wall.y()))) / (2.0 * fall), t = time - kImpact - down;
  Vec3 p = place(time, 0.0, kC);
  if (t > 0.0) p.y() = kFloor - kFloorC * (v + 9.81 * down) * t + fall * t * t;
  return p;
}

Shot wall_and_floor(std::uint64_t seed) {
  Shot shot = ball_and("wall", kRadius, kFps, 1000);
  Random random(seed);
  for (int frame = 0; frame < 120; ++frame) {
    const Vec3 p = place_and_landing(frame / kFps);
    const Vec2 pixel = shot.camera.camera.project(p) + 0.3 * Vec2(random.normal(), random.normal());
    const double radius = shot.camera.camera.fx * kRadius / p.z() * std::exp(0.01 * random.normal());
    if (p.z() > 0.5 && pixel.x() > 0 && pixel.x() < 1280 && pixel.y() > 0 && pixel.y() < 720) shot.observations.push_back({frame, pixel, radius, 0});
  }
  return shot;
}

/// The kink at the floor is plain in the picture, that at the wall is not.
TEST(Wall, OfAFilmIsFoundBeforeTheBallLands) {
  Shot shot = wall_and_floor(1);
  shot.video = "film";
  Context context;
  const Tracks tracks = find_chain(shot, shot.camera, candidates_of(shot.observations, shot.camera), 0, kFps, 0.5, context);
  ASSERT_EQ(tracks.meetings.size(), 2u);
  EXPECT_NEAR(tracks.meetings[0].time, kImpact, 2.0 / kFps);
  EXPECT_EQ(tracks.meetings[0].after, tracks.meetings[1].before);
}

TEST(Wall, IsNotTheFloor) {
  for (const bool told : {true, false}) {
    Shot shot = wall_and_floor(2);
    if (told) shot.bodies[1].normal = -Vec3::UnitZ();
    Context context;
    const Reconstruction r = reconstruct(shot, {}, context);
    ASSERT_EQ(r.impacts.size(), 1u) << told;
    EXPECT_NEAR(r.impacts[0].time, kImpact, 1.0 / kFps) << told;
    ASSERT_TRUE(r.restitution) << told;
    EXPECT_NEAR(r.restitution->value, kC, 0.05) << told;
    const auto& warnings = r.summary.warnings;
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("is left out: it pushed ") != std::string::npos; })) << told;
  }
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

/// In a camera that looks down at the floor bounces are turns along the view ray, and gravity is one too.
TEST(Floor, BelowACameraIsFoundByTheSizes) {
  constexpr double kFirst = 0.452, kSecond = 1.059;  // s: 0.8665 m below, first 0.3 m/s upwards
  for (int seed = 1; seed <= 2; ++seed) {
    const View view{{0, -0.06, 1.9}, 88, 0, {-0.25, -0.1, 0.9}, {0.35, 0.15, 0.3}, 0, 2, 156, 120, 0.005};
    Shot shot = filmed(view, seed);
    shot.video = "film";
    Context context;
    const Tracks tracks = find_chain(shot, shot.camera, candidates_of(shot.observations, shot.camera), 0, view.fps, 0.5, context);
    const auto near = [&](double time) {
      return std::count_if(tracks.meetings.begin(), tracks.meetings.end(), [&](const Tracks::Meeting& m) { return std::abs(m.time - time) < 4.0 / view.fps; });
    };
    EXPECT_EQ(near(kFirst), 1) << seed;
    EXPECT_EQ(near(kFirst) + near(kSecond), static_cast<std::ptrdiff_t>(tracks.meetings.size())) << seed;
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
