// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <cmath>

#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"

namespace unseen::collision {
namespace {

/// A ball seen from the side that bounces off the floor with restitution `c`, at `fps`, as centroids and radii.
Shot bouncing_ball(double c, int frames = 90, double fps = 60) {
  Shot shot;
  shot.name = "ball.shot.json";
  shot.fps = fps;
  shot.camera.camera = {800, 800, 320, 240, 640, 480};
  Body ball, floor;
  ball.name = "ball";
  ball.radius = 0.03;
  floor.name = "floor";
  floor.shape = Shape::fixed;
  shot.bodies = {ball, floor};
  const double height = 0.8, impact = std::sqrt(2.0 * height / 9.81), z = 3.0;
  for (int f = 0; f < frames; ++f) {
    double t = f / fps, speed = std::sqrt(2.0 * 9.81 * height), y = height - 0.5 * 9.81 * t * t;
    double start = impact;
    if (t > impact) {
      speed *= c;
      while (t > start + 2.0 * speed / 9.81) start += 2.0 * speed / 9.81, speed *= c;
      y = speed * (t - start) - 0.5 * 9.81 * (t - start) * (t - start);
    }
    shot.observations.push_back({f, {320 + 800 * (0.1 * t - 0.1) / z, 240 + 800 * (0.5 - y) / z}, 800 * 0.03 / z, 0});
  }
  return shot;
}

TEST(Reconstruct, ReadsTheRestitutionOfABouncingBall) {
  Context context;
  const Reconstruction r = reconstruct(bouncing_ball(0.7), {}, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, 0.7, 0.01);
  EXPECT_GE(r.impacts.size(), 1u);
  EXPECT_NEAR(r.impacts[0].time, std::sqrt(2.0 * 0.8 / 9.81), 0.005);
  EXPECT_EQ(r.fixed, "floor");
  EXPECT_TRUE(r.fits);
  EXPECT_FALSE(r.mass_ratio);
}

TEST(Reconstruct, FastSpinsWhoseOrientationsAreBetterThanTold) {
  SynthOptions synth;
  synth.scene = "spin";
  synth.spin = 20.0;
  synth.fps = 60;
  synth.video = false;
  synth.centroid_noise = 0.01;
  synth.orientation_noise = 2.0;
  const SynthShot shot = simulate(synth);
  Options options;
  options.orientation_noise = 2.0;  // more than they have
  Context context;
  const Reconstruction r = reconstruct(shot.shot, options, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, *shot.truth.restitution, 0.03);  // with one noise only: 0.29 off
}

TEST(Reconstruct, ABounceOfWhichThreeTenthsOfASecondAreUnseen) {
  Shot shot = bouncing_ball(0.7, 55);
  const double impact = std::sqrt(2.0 * 0.8 / 9.81);
  std::erase_if(shot.observations, [&](const Sighting& s) { return std::abs(s.frame / *shot.fps - impact) < 0.15; });
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  ASSERT_EQ(r.impacts.size(), 1u);
  EXPECT_NEAR(r.impacts[0].time, impact, 0.01);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, 0.7, 0.02);
}

TEST(Reconstruct, OneRestitutionForAllImpactsIfAsked) {
  Context context;
  Options options;
  options.shared_restitution = true;
  const Reconstruction r = reconstruct(bouncing_ball(0.7), options, context);
  ASSERT_GE(r.impacts.size(), 2u);
  EXPECT_NEAR(r.impacts[0].restitution.value, r.impacts[1].restitution.value, 0.005);
}

TEST(Reconstruct, AGivenFloorStaysAsGiven) {
  Shot shot = bouncing_ball(0.7);
  const Vec3 normal = Vec3(0.0, -1.0, 0.05).normalized();
  shot.bodies[1].normal = normal;
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  ASSERT_GE(r.impacts.size(), 2u);
  for (const Impact& impact : r.impacts) EXPECT_LT((r.T_world_camera.rotation.transpose() * impact.normal - normal).norm(), 1e-6);
}

TEST(Reconstruct, SaysThatAFlightHasNoCollision) {
  Shot shot = bouncing_ball(0.7, 22);
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(r.impacts.empty());
  EXPECT_FALSE(r.restitution);
  EXPECT_EQ(r.summary.status, Status::infeasible);
}

TEST(Reconstruct, WarnsWhereSizeAndGravityDisagree) {
  Shot shot = bouncing_ball(0.7);
  shot.fps = 48;  // the file's rate is a lie
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  bool warned = false;
  for (const std::string& w : r.summary.warnings) warned |= w.find("frame rate") != std::string::npos;
  EXPECT_TRUE(warned);
}

TEST(Reconstruct, TwoBallsFromTheirCentroids) {
  SynthOptions o;
  o.scene = "balls";
  o.video = false;
  o.fps = 120;
  o.seed = 2;
  const SynthShot synth = simulate(o);
  Context context;
  const Reconstruction r = reconstruct(synth.shot, {}, context);
  ASSERT_EQ(r.impacts.size(), 1u);
  ASSERT_TRUE(r.mass_ratio);
  EXPECT_NEAR(r.mass_ratio->value / *synth.truth.mass_ratio, 1.0, 0.03);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, *synth.truth.restitution, 0.05);
}

TEST(Reconstruct, SameSeedSameValuesAtAnyThreadCount) {
  Context one, two;
  one.threads = 1;
  two.threads = 2;
  const Reconstruction a = reconstruct(bouncing_ball(0.6), {}, one), b = reconstruct(bouncing_ball(0.6), {}, two);
  ASSERT_TRUE(a.restitution && b.restitution);
  EXPECT_EQ(a.restitution->value, b.restitution->value);
  EXPECT_EQ(a.restitution->sd, b.restitution->sd);
}

}  // namespace
}  // namespace unseen::collision
