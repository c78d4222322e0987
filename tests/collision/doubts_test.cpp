// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What a shot does not tell is counted in the intervals, or said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/filmed_bounce.h"
#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// Tracks of centres, off by at most 1 % of the larger body.
SynthShot tracks(const std::string& scene, int seed) {
  SynthOptions o;
  o.scene = scene;
  o.video = false;
  o.centroid_noise = 0.01;
  o.seed = seed;
  return simulate(o);
}

Reconstruction solve(const Shot& shot) {
  Context context;
  return reconstruct(shot, {}, context);
}

bool holds(const std::optional<Estimate>& e, double truth) { return e && e->low <= truth && truth <= e->high; }

bool says(const Reconstruction& r, const std::string& part) {
  return std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [&](const std::string& w) { return w.find(part) != std::string::npos; });
}

/// The same scene from a camera turned about its centre, which moves pixels by a homography.
void turn_camera(Shot& shot, const Mat3& turn) {
  for (Sighting& s : shot.observations) s.pixel = shot.camera.camera.project(turn * shot.camera.camera.unproject(s.pixel.x(), s.pixel.y(), 1.0));
  for (OrientationHint& hint : shot.orientations) hint.q = Quat(turn) * hint.q;
}

TEST(AssumedFocalLength, IsCountedWhereABallComesNearer) {
  int believed = 0, guessed = 0, runs = 0;
  for (const double wrong : {0.8, 1.2})
    for (int seed = 1; seed <= 4; ++seed, ++runs) {
      Shot shot = filmed(towards_the_camera(1), seed);
      shot.camera.camera.fx *= wrong;
      shot.camera.camera.fy *= wrong;
      believed += holds(solve(shot).restitution, kC);
      shot.camera.assumed = true;
      guessed += holds(solve(shot).restitution, kC);
    }
  EXPECT_GE(guessed, runs - 1);
  EXPECT_LT(believed, guessed);
}

/// Bounces below a camera that looks down by 30°, filmed through another lens than the usual one.
TEST(AssumedFocalLength, IsReadFromBouncesBelowTheCamera) {
  const double pitch = radians(30.0), c = 0.7, radius = 0.06, fps = 60;
  for (const double focal : {1500.0, 600.0}) {
    Shot shot;
    shot.name = "below";
    shot.fps = fps;
    shot.camera.camera = {831, 831, 479.5, 269.5, 960, 540};
    shot.camera.assumed = true;
    Body ball, floor;
    ball.name = "ball";
    ball.radius = radius;
    floor.name = "floor";
    floor.shape = Shape::fixed;
    shot.bodies = {ball, floor};
    const Camera lens = {focal, focal, 479.5, 269.5, 960, 540};
    const Mat3 turn = Eigen::AngleAxisd(pitch, Vec3::UnitX()).toRotationMatrix();  // from level, y down
    Random random(5);
    double height = 0.7, up = 0;
    for (int frame = 0; frame < 80; ++frame) {
      const Vec3 level(-0.25 + 0.4 * frame / fps, -height, 0.3 - 0.5 * frame / fps);
      const Vec3 p = turn * level + Vec3(0, 0.25, focal / 831 * 1.8);
      Sighting s;
      s.frame = frame;
      s.pixel = lens.project(p) + 0.2 * Vec2(random.normal(), random.normal());
      s.radius = focal * radius / p.z() + 0.2 * random.normal();
      shot.observations.push_back(s);
      double left = 1 / fps;
      while (true) {  // to the next bounce, or the next frame
        const double falls = (up + std::sqrt(up * up + 2 * 9.81 * height)) / 9.81;
        if (falls > left) break;
        up = c * std::sqrt(up * up + 2 * 9.81 * height), height = 0, left -= falls;
      }
      height += up * left - 0.5 * 9.81 * left * left;
      up -= 9.81 * left;
    }
    const Reconstruction r = solve(shot);
    EXPECT_NEAR(r.camera.fx, focal, 0.1 * focal);
    EXPECT_TRUE(says(r, "estimated from the flights"));
    ASSERT_TRUE(r.restitution);
    EXPECT_NEAR(r.restitution->value, c, 0.015);
  }
}

TEST(AssumedFocalLength, HardlyMattersWhereBodiesFlyAcross) {
  Shot shot = tracks("balls", 1).shot;
  const Reconstruction known = solve(shot);
  shot.camera.assumed = true;
  const Reconstruction assumed = solve(shot);
  ASSERT_TRUE(known.restitution && assumed.restitution);
  EXPECT_LT(assumed.restitution->sd, 1.5 * known.restitution->sd);
  EXPECT_EQ(assumed.camera.fx, known.camera.fx);
  EXPECT_TRUE(says(assumed, "intrinsics are assumed"));
}

TEST(Unused, FloorsAndOrientationsThatTellNothingAreRemarkedOn) {
  Shot shot = tracks("balls", 1).shot;
  EXPECT_FALSE(says(solve(shot), "not used"));
  shot.floor = Plane{-Vec3::UnitY(), -2.0};
  EXPECT_TRUE(says(solve(shot), "floor: not used"));
  shot.orientations.push_back({0, 0.1, Quat::Identity()});
  EXPECT_TRUE(says(solve(shot), "orientations: those of " + shot.bodies[0].name));
}

TEST(Unused, ARegionOfThePictureIsOneWithoutVideo) {
  Shot shot = tracks("balls", 1).shot;
  shot.roi = {5000, 5000, 100, 100};
  EXPECT_TRUE(says(solve(shot), "roi: not used"));
}

TEST(GivenDown, IsComparedWithTheFlights) {
  Shot shot = tracks("balls", 1).shot;
  const Vec3 down = solve(shot).T_world_camera.rotation.transpose() * -Vec3::UnitZ();
  for (const double wrong : {0.0, 20.0, 180.0}) {
    shot.down = Eigen::AngleAxisd(radians(wrong), Vec3::UnitZ()) * down;
    const Reconstruction r = solve(shot);
    EXPECT_EQ(says(r, "down: by the flights") || !r.fits, wrong > 0.0) << wrong;
  }
}

TEST(HitsOffTheCentre, OfBodiesKnownByTheirSizeAreCounted) {
  int held = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const SynthShot synth = tracks("offcentre", seed);
    Shot shot = synth.shot;
    shot.orientations.clear();
    for (Body& body : shot.bodies) {
      body.size = body.box.maxCoeff();
      body.shape = Shape::size;
    }
    const Reconstruction r = solve(shot);
    ASSERT_EQ(r.impacts.size(), 1u) << seed;
    held += holds(r.impacts[0].restitution, *synth.truth.restitution);
    EXPECT_TRUE(std::any_of(r.ambiguous.begin(), r.ambiguous.end(), [](const Alternative& a) { return a.what.find("off the centre") != std::string::npos; }));
  }
  EXPECT_GE(held, 3);
}

TEST(GivenNormal, TellsFrictionFromLostBounceWhateverTheShape) {
  Shot shot = tracks("box-floor", 1).shot;
  shot.orientations.clear();
  shot.bodies[0].size = shot.bodies[0].box.maxCoeff();
  shot.bodies[0].shape = Shape::size;
  const auto by_friction = [](const Alternative& a) { return a.what.find("with a friction of") != std::string::npos; };
  for (const bool given : {true, false}) {
    if (!given) shot.bodies[1].normal.reset(), shot.down.reset();
    const Reconstruction r = solve(shot);
    ASSERT_EQ(r.impacts.size(), 1u) << given;
    EXPECT_EQ(std::any_of(r.ambiguous.begin(), r.ambiguous.end(), by_friction), !given) << given;
  }
}

TEST(Labels, WithoutThemAndWithoutSizesTheMassRatioIsAmbiguous) {
  const SynthShot synth = tracks("balls", 2);
  Shot shot = synth.shot;
  for (Sighting& s : shot.observations) s.radius = 0.0;
  const Reconstruction labelled = solve(shot);
  EXPECT_TRUE(labelled.mass_ratio);
  for (Sighting& s : shot.observations) s.body = -1;
  const Reconstruction r = solve(shot);
  ASSERT_EQ(r.impacts.size(), 1u);
  EXPECT_FALSE(r.mass_ratio);
  EXPECT_TRUE(says(r, "the other way round"));
  ASSERT_GE(r.ambiguous.size(), 2u);
  const double m = *synth.truth.mass_ratio;
  for (const double either : {m, 1.0 / m})
    EXPECT_TRUE(std::any_of(r.ambiguous.begin(), r.ambiguous.end(), [&](const Alternative& a) { return std::abs(a.mass_ratio / either - 1.0) < 0.1; })) << either;
}

TEST(UnknownDown, IsFoundWithTheImpactWhereTheCameraLooksDown) {
  for (const double pitch : {15.0, 50.0})
    for (const int seed : {1, 3}) {
      const SynthShot synth = tracks("balls", seed);
      Shot shot = synth.shot;
      shot.down.reset();
      turn_camera(shot, Mat3(Eigen::AngleAxisd(radians(pitch), Vec3::UnitX())));
      const Reconstruction r = solve(shot);
      ASSERT_EQ(r.impacts.size(), 1u) << pitch << " " << seed;
      EXPECT_NEAR(r.impacts[0].frame, synth.truth.impacts[0].frame, 1.0) << pitch << " " << seed;
      ASSERT_TRUE(r.restitution) << pitch << " " << seed;
      EXPECT_NEAR(r.restitution->value, *synth.truth.restitution, 0.02) << pitch << " " << seed;
    }
}

TEST(NothingFound, SaysWhatIsMissing) {
  Shot one = tracks("balls", 1).shot;
  std::erase_if(one.observations, [](const Sighting& s) { return s.body == 1; });
  EXPECT_TRUE(says(solve(one), one.bodies[1].name + " has no sightings"));
  Shot planar = tracks("planar", 2).shot;
  planar.metres_per_pixel.reset();
  for (Sighting& s : planar.observations) s.radius = 0.0;
  const Reconstruction r = solve(planar);
  EXPECT_TRUE(r.impacts.empty());
  EXPECT_TRUE(says(r, "tells the scale"));
}

}  // namespace
}  // namespace unseen::collision
