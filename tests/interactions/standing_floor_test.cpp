// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/standing_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "interactions/ground/ground.h"
#include "interactions/method_samples.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

constexpr Camera kCamera{1250, 1250, 959.5, 539.5, 1920, 1080};

Ground ground_at(double pitch_deg, double height) {
  return {height, radians(pitch_deg), 0, ""};
}

/// Where a body's points are (m): how far ankles, knees, hips and shoulders are above the floor and ahead of
/// the hips.
struct StandOrSit {
  Vec2 ankle, knee, hip, shoulder;  // ahead, above
};
constexpr double kShinLength = 0.40, kThighLength = 0.37, kTrunkLength = 0.44, kAnkleUp = 0.13;  // m

StandOrSit stands_straight() {
  return {{0, kAnkleUp},
          {0, kAnkleUp + kShinLength},
          {0, kAnkleUp + kShinLength + kThighLength},
          {0, kAnkleUp + kShinLength + kThighLength + kTrunkLength}};
}
StandOrSit sits_down() {
  return {{kThighLength, kAnkleUp},
          {kThighLength, kAnkleUp + kShinLength},
          {0, kAnkleUp + kShinLength},
          {0, kAnkleUp + kShinLength + kTrunkLength}};
}

/// A detection without noise of somebody at `at` who faces `facing` (rad, 0 = along the view); everything is
/// `stature` times as large.
Detection body_seen(const View& view, const StandOrSit& posture, const Vec2& at, double facing,
                    double stature, int frame, int person = 0) {
  constexpr double kHalfWide = 0.1;  // m, the joints of both sides apart
  Detection d;
  d.frame = frame;
  d.person = person;
  const Vec2 ahead(-std::sin(facing), std::cos(facing)), right(std::cos(facing), std::sin(facing));
  const auto put = [&](Joint of_right, Joint of_left, const Vec2& point) {
    for (const auto& [joint, side] : {std::pair{of_right, kHalfWide}, {of_left, -kHalfWide}}) {
      const Vec2 on_floor = at + stature * (point.x() * ahead + side * right);
      d.pixels.col(joint) =
          view.project(Vec3(on_floor.x(), on_floor.y(), kAnkleUp + stature * (point.y() - kAnkleUp)));
      d.confidence[joint] = 1;
    }
  };
  put(right_ankle, left_ankle, posture.ankle);
  put(right_knee, left_knee, posture.knee);
  put(right_hip, left_hip, posture.hip);
  put(right_shoulder, left_shoulder, posture.shoulder);
  return d;
}

Take nobodys_take(int people = 1) {
  Take take;
  take.camera = kCamera;
  take.people = people;
  take.fps = 10;
  return take;
}

TEST(StandingFloor, IsExactForUprightBodies) {
  for (const Ground& truth :
       {ground_at(12, 1.8), ground_at(25, 2.4), ground_at(45, 2.7), ground_at(65, 3.0)}) {
    Take take = nobodys_take(2);
    const View view = view_of(kCamera, truth);
    const double away = truth.camera_height / std::tan(truth.pitch);
    Random random(5);
    for (int i = 0; i < 200; ++i)
      take.detections.push_back(body_seen(view, stands_straight(),
                                          {random.uniform(-1, 1), away + random.uniform(-1, 1.5)}, 0,
                                          i % 2 ? 1.04 : 0.96, i, i % 2));
    const FloorBelief any{{std::log(1.4), 0.1, 0}, Vec3(0.16, 0.09, 0.001).asDiagonal()};
    const FloorBelief found = standing_floor(take, any, Context());
    const double height = std::exp(found.mean[0]) + kAnkleHeight;
    EXPECT_NEAR(degrees(found.mean[1]), degrees(truth.pitch), 0.5);
    EXPECT_NEAR(degrees(found.mean[2]), 0, 0.5);
    EXPECT_NEAR(height, truth.camera_height, 0.03 * truth.camera_height);
    EXPECT_GT(found.covariance(0, 0), 0);
    EXPECT_LT(std::abs(height - truth.camera_height),
              3 * std::sqrt(found.covariance(0, 0)) * truth.camera_height);
  }
}

TEST(StandingFloor, NobodyLeavesTheBelief) {
  const FloorBelief any{{0.3, 0.1, 0}, Vec3(0.16, 0.09, 0.001).asDiagonal()};
  const FloorBelief found = standing_floor(nobodys_take(), any, Context());
  EXPECT_LT((found.mean - any.mean).norm(), 1e-9);
  EXPECT_LT((found.covariance - any.covariance).norm(), 1e-9);
}

/// Somebody walks 3 m towards a place beside the view's middle, sits for long, and walks away: noise-free.
Take walks_and_sits(const Ground& truth, double seat_away, int seated_frames) {
  Take take = nobodys_take();
  const View view = view_of(kCamera, truth);
  int frame = 0;
  const Vec2 seat(0.6, seat_away);
  const auto walk = [&](const Vec2& from, const Vec2& to, double facing) {
    for (int i = 0; i < 30; ++i)
      take.detections.push_back(
          body_seen(view, stands_straight(), from + i / 29.0 * (to - from), facing, 1, frame++));
  };
  walk({-1.4, seat_away + 1.5}, seat, 2.5);
  for (int i = 0; i < seated_frames; ++i)
    take.detections.push_back(body_seen(view, sits_down(), seat, 2.6, 1, frame++));
  walk(seat, {1.2, seat_away - 1.2}, 3.5);
  return take;
}

TEST(FindGround, IsNotMisledByWhoSits) {
  for (const Ground& truth : {ground_at(10.5, 1.48), ground_at(15, 1.75), ground_at(25.5, 2.5)}) {
    for (const int seated_frames : {0, 150, 600}) {
      Context context;
      const Ground found = find_ground(walks_and_sits(truth, 4.0, seated_frames), context).ground;
      EXPECT_NEAR(degrees(found.pitch), degrees(truth.pitch), 1.5) << seated_frames;
      EXPECT_NEAR(found.camera_height, truth.camera_height, 0.06 * truth.camera_height) << seated_frames;
    }
  }
}

TEST(FindGround, SaysThatThePitchIsUncertain) {
  const Ground truth = ground_at(10.5, 1.48);
  const auto warnings = [](const Take& take) {
    Context context;
    find_ground(take, context);
    return context.take_warnings();
  };
  EXPECT_TRUE(warnings(walks_and_sits(truth, 4.0, 100)).empty());
  Take stands = nobodys_take();
  for (int i = 0; i < 20; ++i)
    stands.detections.push_back(body_seen(view_of(kCamera, truth), stands_straight(), {0, 4}, 0, 1, i));
  const std::vector<std::string> said = warnings(stands);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("pitch is uncertain"), std::string::npos) << said[0];
}

TEST(FindGround, SaysThatTheCameraSeemsRolled) {
  const Ground truth = ground_at(6, 1.4);
  for (const double roll_deg : {0.0, 1.0, 5.0, -5.0}) {
    Take take = nobodys_take();
    Ground rolled = truth;
    rolled.roll = radians(roll_deg);
    const View view = view_of(kCamera, rolled);
    for (int i = 0; i < 120; ++i)
      take.detections.push_back(body_seen(
          view, stands_straight(), {2 * std::sin(0.1 * i), 4.5 + 1.5 * std::cos(0.07 * i)}, 0.1 * i, 1, i));
    Context context;
    find_ground(take, context);
    const std::vector<std::string> said = context.take_warnings();
    const bool warned = std::any_of(said.begin(), said.end(), [](const std::string& warning) {
      return warning.find("rolled") != std::string::npos;
    });
    EXPECT_EQ(warned, std::abs(roll_deg) > 3) << roll_deg;
  }
}

/// What people do in the truth, filmed by another camera that aims at the middle of their paths.
Take filmed(const Recording& truth, const Ground& ground, std::uint64_t seed) {
  constexpr double kNoise = 5, kAimedAt = 0.9;  // px, m
  Random random(seed);
  Take take;
  take.camera = kCamera;
  take.fps = truth.fps;
  take.people = 1;
  const View view = view_of(take.camera, ground);
  Vec3 middle = Vec3::Zero();
  for (const RecordedFrame& frame : truth.people[0])
    middle += frame.pose.col(pelvis) / static_cast<double>(truth.people[0].size());
  const Vec3 moved(-middle.x(), (ground.camera_height - kAimedAt) / std::tan(ground.pitch) - middle.y(), 0);
  for (const RecordedFrame& frame : truth.people[0]) {
    Detection d;
    d.frame = frame.frame;
    d.person = 0;
    for (int j = 0; j < kJoints; ++j) {
      const Vec3 joint = frame.pose.col(j) + moved;
      if ((view.T_world_camera.inverse() * joint).z() < 0.3) continue;
      d.pixels.col(j) = view.project(joint) + kNoise * Vec2(random.normal(), random.normal());
      const bool inside = d.pixels(0, j) > 0 && d.pixels(1, j) > 0 && d.pixels(0, j) < take.camera.width &&
                          d.pixels(1, j) < take.camera.height;
      d.confidence[j] = inside ? 0.85 : 0.0;
    }
    take.detections.push_back(d);
  }
  return take;
}

/// People who walk, sit and reach under tilted cameras. Measured: medians of at most 0.15 m and 1.3°, and at
/// most 5.5° in any take.
TEST(FindGround, SeesThatTheCameraLooksDown) {
  for (const Ground& truth :
       {ground_at(15, 2.0), ground_at(25, 2.4), ground_at(35, 2.6), ground_at(45, 2.7)}) {
    std::vector<double> heights, pitches;
    for (int seed = 3101; seed < 3112; ++seed) {
      Context context;
      const Ground found = find_ground(filmed(simulate(test::synth_options(seed)).truth, truth,
                                              static_cast<std::uint64_t>(seed)),
                                       context)
                               .ground;
      heights.push_back(std::abs(found.camera_height - truth.camera_height));
      pitches.push_back(std::abs(degrees(found.pitch - truth.pitch)));
    }
    std::sort(heights.begin(), heights.end());
    std::sort(pitches.begin(), pitches.end());
    EXPECT_LT(heights[5], 0.3) << degrees(truth.pitch);
    EXPECT_LT(pitches[5], 2.5) << degrees(truth.pitch);
    EXPECT_LT(pitches.back(), 8.0) << degrees(truth.pitch);
  }
}

}  // namespace
}  // namespace unseen::interactions
