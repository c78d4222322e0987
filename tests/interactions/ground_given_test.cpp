// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "interactions/ground/ground.h"
#include "interactions/ground/ground_fit.h"
#include "interactions/ground/sight.h"
#include "unseen/interactions/synth.h"

namespace unseen::interactions {
namespace {

Take walking(int seconds = 20) {
  SynthOptions options;
  options.seconds = seconds;
  options.noise = 0;
  options.lifted = false;
  Take take = simulate(options).take;
  for (Detection& detection : take.detections) detection.person = 0;
  return take;
}

/// The same take by a camera that is rolled about its axis.
Take rolled(Take take, double roll) {
  const Vec2 middle(take.camera.cx, take.camera.cy);
  for (Detection& d : take.detections) d.pixels = (Eigen::Rotation2Dd(-roll).toRotationMatrix() * (d.pixels.colwise() - middle)).colwise() + middle;
  return take;
}

/// Up in camera coordinates, by the view itself.
Vec3 up_of(const Take& take, const Ground& ground) { return view_of(take.camera, ground).T_world_camera.rotation.transpose() * Vec3::UnitZ(); }

TEST(GivenGround, RollOfTheCameraChangesNothingElse) {
  Take take = walking();
  take.up = up_of(take, {1.2, 0.08, 0, ""});
  Context context;
  const Ground level = find_ground(take, context).ground;
  for (const double roll : {-1.5, -0.3, 0.2, 1.0, 3.0}) {
    Take turned = rolled(take, roll);
    turned.up = up_of(take, {1.2, 0.08, roll, ""});
    const Ground found = find_ground(turned, context).ground;
    EXPECT_NEAR(found.roll, roll, 1e-9);
    EXPECT_NEAR(found.pitch, level.pitch, 1e-9);
    EXPECT_NEAR(found.camera_height, level.camera_height, 1e-6);
    EXPECT_EQ(found.source, level.source);
  }
}

TEST(GivenGround, TopOfThePictureIsAheadOfACameraThatLooksStraightDown) {
  Take take = walking(4);
  take.camera_height = 2.5;
  for (const Vec3& up : {Vec3(0, 0, -1), Vec3(0.01, -0.02, -1), Vec3(0.02, 0, -1), Vec3(-0.03, 0.05, -1)}) {
    take.up = up.normalized();
    Context context;
    const Mat3 rotation = view_of(take.camera, find_ground(take, context).ground).T_world_camera.rotation;
    EXPECT_LT((rotation * *take.up - Vec3::UnitZ()).norm(), 1e-9);
    const Vec3 top = rotation * -Vec3::UnitY();
    EXPECT_NEAR(top.x(), 0, 1e-9);
    EXPECT_GT(top.y(), 0.99);
    EXPECT_TRUE(context.take_warnings().empty()) << "nobody looks upright from above";
  }
  take.up = Vec3(0, 0, -1);
  Context context;
  EXPECT_EQ(find_ground(take, context).ground.roll, 0);
}

bool doubts_up(const Take& take) {
  Context context;
  find_ground(take, context);
  for (const std::string& warning : context.take_warnings())
    if (warning.find("\"up\" may be wrong") != std::string::npos) return true;
  return false;
}

TEST(GivenGround, IsDoubtedIfFeetAreSeenWhereNoFloorCanBe) {
  Take take = walking(4);
  for (const Vec3& up : {Vec3(0, -1, 0), Vec3(0, -1, -0.1), Vec3(0.05, -1, -0.3)}) {
    take.up = up.normalized();
    EXPECT_FALSE(doubts_up(take)) << up.transpose();
  }
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, -1, 1), Vec3(0, 1, 0)}) {
    take.up = up.normalized();
    EXPECT_TRUE(doubts_up(take)) << up.transpose();
  }
}

TEST(GivenGround, IsDoubtedIf3DPosesLie) {
  SynthOptions options;
  options.seconds = 4;
  Take take = simulate(options).take;
  take.up = Vec3(0, -1, -0.1).normalized();
  EXPECT_FALSE(doubts_up(take));
  take.up = Vec3(0, 0, -1);  // from above nobody would look upright: only their 3D poses tell
  EXPECT_TRUE(doubts_up(take));
}

TEST(GivenGround, IsKept) {
  Take take = walking(4);
  Database database = build_database({simulate({}).truth}, {}, *std::make_unique<Context>());
  Context context;
  take.camera_height = 6.5;  // higher and steeper than a search would go
  EXPECT_EQ(fit_ground(take, database, find_ground(take, context), context).camera_height, 6.5);
  take.camera_height.reset();
  take.up = Vec3(0, -0.3, -std::sqrt(1 - 0.09));
  EXPECT_NEAR(fit_ground(take, database, find_ground(take, context), context).pitch, std::asin(std::sqrt(1 - 0.09)), 1e-3);
}

TEST(GivenGround, JointsOnOnePointSayNothingOfTheGround) {
  Take take = walking(4);
  for (Detection& d : take.detections) {
    d.pixels.colwise() = Vec2(500, 500);
    d.confidence.setConstant(0.9);
  }
  Context context;
  const GroundStart start = find_ground(take, context);
  EXPECT_EQ(start.ground.source, "assumed");
  Database database = build_database({simulate({}).truth}, {}, context);
  EXPECT_TRUE(std::isfinite(fit_ground(take, database, start, context).camera_height));
}

}  // namespace
}  // namespace unseen::interactions
