// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/restitution.h"
#include "collision/filmed_bounce.h"
#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"

namespace unseen::collision {
namespace {

/// How many of so many shots have an interval that holds the truth.
int held(const View& view, int runs) {
  int count = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    Context context;
    const Reconstruction r = reconstruct(filmed(view, seed), {}, context);
    count += r.restitution && r.restitution->low <= kC && kC <= r.restitution->high;
  }
  return count;
}

TEST(LevelFloor, TheNormalIsTheVerticalThatWasFound) {
  Context context;
  const Reconstruction r = reconstruct(filmed(towards_the_camera(1), 1), {}, context);
  ASSERT_EQ(r.impacts.size(), 1u);
  EXPECT_LT((r.impacts[0].normal - Vec3::UnitZ()).norm(), 1e-6);
}

TEST(LevelFloor, IntervalsHoldTheTruthWhereTheCameraLooksDownAndTheBallComesNearer) {
  EXPECT_GE(held(towards_the_camera(1), 6), 5);
  EXPECT_GE(held(towards_the_camera(2), 6), 5);
}

TEST(LevelFloor, ARolledCameraReadsTheRestitution) {
  for (const double roll : {30.0, 90.0}) {
    Context context;
    const Reconstruction r = reconstruct(filmed({{0, -2.2, 0.7}, 0, roll, {-0.5, 0, 1.1}, {0.7, 0, 0}, 0, 1, 50}, 1), {}, context);
    ASSERT_TRUE(r.restitution) << roll;
    EXPECT_NEAR(r.restitution->value, kC, 0.03) << roll;
    EXPECT_LE(r.restitution->low, kC) << roll;
    EXPECT_GE(r.restitution->high, kC) << roll;
  }
}

/// A ball that falls straight on a floor tilted by 15°, as one that spins would leave a level one.
TEST(LevelFloor, ATiltThatNoFrictionExplainsIsToldAndCounted) {
  Shot shot = filmed({{0, -2.2, 0.7}, 0, 0, {0, 0, 1.0}, {0, 0, -0.5}, 15, 1, 45}, 1);
  shot.down = Vec3::UnitY();
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_LE(r.restitution->low, kC);
  EXPECT_GE(r.restitution->high, kC);
  ASSERT_FALSE(r.ambiguous.empty());
  EXPECT_NEAR(r.ambiguous.front().restitution, kC, 0.03);
  EXPECT_TRUE(std::any_of(r.observability.begin(), r.observability.end(), [](const std::string& s) { return s.find("taken to be level") != std::string::npos; }));
}

TEST(LevelFloor, AnOrdinaryBounceIsNotAmbiguous) {
  Context context;
  EXPECT_TRUE(reconstruct(filmed({{0, -2.2, 0.7}, 0, 20, {-0.5, 0, 1.1}, {0.7, 0, 0}, 0, 1, 50}, 1), {}, context).ambiguous.empty());
}

TEST(LevelFloor, ANormalThatTheFlightsContradictIsSaid) {
  for (const double off : {0.0, 20.0}) {  // degrees, across the view
    Shot shot = filmed({{0, -2.2, 0.7}, 0, 0, {-0.5, 0, 1.1}, {0.7, 0, 0}, 0, 2, 50}, 1);
    shot.bodies[1].normal = Vec3(std::sin(radians(off)), -std::cos(radians(off)), 0);
    Context context;
    const std::vector<std::string> said = reconstruct(shot, {}, context).summary.warnings;
    EXPECT_EQ(std::any_of(said.begin(), said.end(), [](const std::string& w) { return w.find("leans by 20° from the vertical") != std::string::npos; }), off > 0.0) << off;
    EXPECT_EQ(std::any_of(said.begin(), said.end(), [](const std::string& w) { return w.find("leans by") != std::string::npos; }), off > 0.0) << off;
  }
}

TEST(UnknownNormal, AWallThatNobodyDescribedReadsTheRestitution) {
  const View wall{{0, -2.2, 0.7}, 0, 0, {0.8, 0.0, 0.6}, {-3.5, 0.2, 1.9}, 80, 1, 30};
  for (int seed = 1; seed <= 3; ++seed) {
    Context context;
    const Reconstruction r = reconstruct(filmed(wall, seed), {}, context);
    ASSERT_TRUE(r.restitution) << seed << " " << (r.summary.warnings.empty() ? "" : r.summary.warnings[0]);
    EXPECT_NEAR(r.restitution->value, kC, 0.05) << seed;
    EXPECT_LT(r.restitution->low, kC) << seed;
    EXPECT_GT(r.restitution->high, kC) << seed;
  }
}

TEST(ModelCheck, AWrongSightingOrTwoRefuseNothing) {
  SynthOptions synth;
  synth.scene = "balls";
  synth.video = false;
  synth.centroid_noise = 0.01;
  Context context;
  Shot shot = simulate(synth).shot;
  shot.observations[10].pixel += Vec2(40, -25);
  shot.observations[shot.observations.size() - 9].pixel += Vec2(-30, 50);
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(r.fits);
  EXPECT_TRUE(r.restitution);
  int seen = 0;
  for (const Residual& residual : r.residuals)
    if ((residual.seen - residual.predicted).norm() > 15.0) {
      ++seen;
      EXPECT_FALSE(residual.used);
    }
  EXPECT_EQ(seen, 2);
}

TEST(Orientations, OfATimeWithoutFlightsAreLeftOutAndTold) {
  SynthOptions synth;
  synth.scene = "boxes";
  synth.video = false;
  Shot shot = simulate(synth).shot;
  Context context;
  const Reconstruction without = reconstruct(shot, {}, context);
  EXPECT_TRUE(without.summary.warnings.empty());
  shot.orientations.push_back(shot.orientations[0]);
  shot.orientations.back().time = 1e6;
  const Reconstruction with = reconstruct(shot, {}, context);
  ASSERT_TRUE(with.restitution && without.restitution);
  EXPECT_EQ(with.restitution->value, without.restitution->value);
  ASSERT_EQ(with.summary.warnings.size(), 1u);
  EXPECT_NE(with.summary.warnings[0].find("orientations["), std::string::npos);
}

TEST(Restitution, ErrorsThatImpactsShareDoNotAverageOut) {
  const std::vector<Estimate> two = {{0.7, 0.02, 0, 0}, {0.7, 0.02, 0, 0}};
  EXPECT_NEAR(pooled(two).sd, 0.02 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(pooled(two, {Vec3(0.02, 0, 0), Vec3(0.02, 0, 0)}).sd, 0.02, 1e-12);
}

}  // namespace
}  // namespace unseen::collision
