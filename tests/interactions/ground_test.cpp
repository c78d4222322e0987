// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "interactions/ground/ground_fit.h"
#include "interactions/method_samples.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::interactions {
namespace {

struct Error {
  double height, pitch;  // m, rad
};

Ground truth_of(const SynthTake& synth) {
  const RigidTransform& T = synth.truth.T_world_camera;
  return {T.translation.z(), std::asin(-T.rotation(2, 2)), 0, "given"};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

using FindsGround = Ground (*)(const Take& take);

/// Medians over generated takes.
Error median_error(FindsGround find, int takes) {
  std::vector<double> heights, pitches;
  for (int seed = 3001; seed < 3001 + takes; ++seed) {
    const SynthTake synth = simulate(test::synth_options(seed));
    const Ground found = find(test::with_persons(synth.take)), truth = truth_of(synth);
    heights.push_back(std::abs(found.camera_height - truth.camera_height));
    pitches.push_back(std::abs(found.pitch - truth.pitch));
    EXPECT_EQ(found.source, "feet");
  }
  return {median(heights), median(pitches)};
}

/// Measured: 0.09 m and 0.6°.
TEST(FindGround, IsNearTheFloorOfGeneratedTakes) {
  const Error error = median_error([](const Take& take) {
    Context context;
    return find_ground(take, context).ground;
  }, 36);
  EXPECT_LT(error.height, 0.13);
  EXPECT_LT(degrees(error.pitch), 1.2);
}

/// Measured: 0.04 m and 0.5°.
TEST(FitGround, IsNearTheFloorOfGeneratedTakes) {
  const Error error = median_error([](const Take& take) {
    Context context;
    return fit_ground(take, report::shipped_database(), find_ground(take, context), context);
  }, 6);
  EXPECT_LT(error.height, 0.12);
  EXPECT_LT(degrees(error.pitch), 1.5);
}

TEST(FitGround, KeepsWhatTheTakeGives) {
  const SynthTake synth = simulate(test::synth_options(3001, 10));
  const Ground truth = truth_of(synth);
  const Vec3 up = synth.truth.T_world_camera.rotation.transpose() * Vec3::UnitZ();
  for (const bool height : {false, true})
    for (const bool tilt : {false, true}) {
      Take take = test::with_persons(synth.take);
      if (height) take.camera_height = truth.camera_height;
      if (tilt) take.up = up;
      Context context;
      const Ground ground = fit_ground(take, report::shipped_database(), find_ground(take, context), context);
      if (height) {
        EXPECT_EQ(ground.camera_height, truth.camera_height);
      }
      if (tilt) {
        EXPECT_NEAR(ground.pitch, truth.pitch, 1e-3);
      }
      EXPECT_EQ(ground.source, height ? "given" : "feet");
      EXPECT_LT(std::abs(ground.camera_height - truth.camera_height), 0.6);
    }
}

TEST(FindGround, TakesTiltAndRollFromUp) {
  Take take;
  take.camera = {1000, 1000, 960, 540, 1920, 1080};
  Ground tilted{1.3, 0.3, 0.2, "given"};
  take.camera_height = 1.3;
  take.up = view_of(take.camera, tilted).T_world_camera.rotation.transpose() * Vec3::UnitZ();
  Context context;
  const Ground found = find_ground(take, context).ground;
  EXPECT_NEAR(found.pitch, 0.3, 1e-3);
  EXPECT_NEAR(found.roll, 0.2, 1e-6);
  const Mat3 rotation = view_of(take.camera, found).T_world_camera.rotation;
  EXPECT_NEAR((rotation * *take.up - Vec3::UnitZ()).norm(), 0, 2e-3);
  EXPECT_TRUE(context.take_warnings().empty());
}

TEST(FindGround, WarnsWhereNobodyIsSeenUpright) {
  Take take = test::with_persons(simulate(test::synth_options(3002, 10)).take);
  for (Detection& d : take.detections)
    for (const Joint joint : {right_ankle, left_ankle}) d.confidence[joint] = 0;
  Context context;
  const GroundStart start = find_ground(take, context);
  EXPECT_EQ(start.ground.source, "assumed");
  EXPECT_EQ(context.take_warnings().size(), 1u);
  EXPECT_GT(start.ground.camera_height, 0.8);
  EXPECT_LT(start.ground.camera_height, 1.8);
}

}  // namespace
}  // namespace unseen::interactions
