// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "cuboids/objects/groove.h"
#include "cuboids/objects/stack_levels.h"
#include "cuboids/search/complete.h"
#include "perception_scenes.h"
#include "synth_frame.h"

namespace unseen::cuboids::test {
namespace {

/// Every box of the scene is there, and no other.
void expect_boxes(const Scene& scene, const std::vector<Cuboid>& cuboids, double error, const std::string& what) {
  ASSERT_EQ(cuboids.size(), scene.boxes.size()) << what;
  for (const OrientedBox& box : scene.boxes) EXPECT_LT(size_error(nearest(cuboids, box.center).box, box), error) << what;
}

std::vector<int> all_points_of_objects(const Observation& seen) {
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(seen.points.size()); ++i)
    if (seen.support_of_point[i] < 0) points.push_back(i);
  return points;
}

/// Heights of the levels that all objects together are cut at: where the pieces of a stack begin.
std::vector<double> levels(const Observation& seen) {
  const Stacks stacks = find_stacks(seen, {all_points_of_objects(seen)}, Context());
  std::vector<double> low(stacks.stack_of_piece.size(), 1e9);
  for (std::size_t i = 0; i < seen.points.size(); ++i) low[stacks.piece_of_point[i]] = std::min(low[stacks.piece_of_point[i]], seen.points[i].z());
  return low.size() > 2 ? std::vector<double>(low.begin() + 2, low.end()) : std::vector<double>();
}

Observation observed(const Scene& scene) {
  Context context;
  return observe(render(scene), {}, context);
}

TEST(StackLevels, LieWhereTheTurnChanges) {
  for (const double turn : {6.0, 12.0, 20.0, 40.0}) {
    Scene scene;
    scene.boxes = {upright(0, 1.2, 0, {0.3, 0.26, 0.2}, 25), upright(0, 1.2, 0.2, {0.3, 0.26, 0.24}, 25 + turn)};
    scene.height = 0.9;
    const std::vector<double> z = levels(observed(scene));
    ASSERT_EQ(z.size(), 1u) << turn;
    EXPECT_NEAR(z[0], 0.2, 0.005) << turn;
  }
}

TEST(StackLevels, NoneLiesWithinABox) {  // where the first cut of a tower may
  int found = 0;
  for (double yaw = 0.0; yaw < 90.0; yaw += 5.0) {
    Scene scene;
    scene.boxes = {upright(0, 1.1, 0, {0.283, 0.224, 0.171}, yaw), upright(-0.02, 1.1, 0.171, {0.305, 0.228, 0.154}, yaw - 17),
                   upright(0, 1.12, 0.325, {0.257, 0.254, 0.237}, yaw - 21)};
    scene.height = 0.8;
    scene.pitch = radians(26.0);
    const std::vector<double> z = levels(observed(scene));
    EXPECT_LE(z.size(), 2u) << yaw;
    if (z.size() != 2) continue;
    ++found;
    EXPECT_NEAR(z[0], 0.171, 0.008) << yaw;
    EXPECT_NEAR(z[1], 0.325, 0.008) << yaw;
  }
  EXPECT_GE(found, 14);  // of 18; where one side alone looks at the camera, or the upper two are nearly in line, there is little to tell
}

/// Cartons whose fronts are so nearly in line that their noise hides the step between them: the outline tells.
TEST(StackLevels, LieWhereTheOutlineSteps) {
  int found = 0;
  for (double yaw = -10.0; yaw <= 10.0; yaw += 2.0) {
    const auto at = [&](double across, double in, double z, const Vec3& size) {
      const Vec2 p = Vec2(0, 2.9) + Eigen::Rotation2Dd(radians(yaw)) * Vec2(across, in + 0.5 * size.y());
      return upright(p.x(), p.y(), z, size, yaw);
    };
    Scene scene;
    scene.boxes = {at(0, 0, 0, {0.6, 0.4, 0.4}), at(0.01, 0.025, 0.4, {0.5, 0.35, 0.3})};
    scene.height = 0.7;
    scene.pitch = radians(8.0);
    scene.noise = 0.0015;
    const std::vector<double> z = levels(observed(scene));
    ASSERT_LE(z.size(), 1u) << yaw;
    if (z.empty()) continue;
    ++found;
    EXPECT_NEAR(z[0], 0.4, 0.015) << yaw;
  }
  EXPECT_EQ(found, 11);
}

TEST(StackLevels, WhatStandsSideBySideHasNone) {  // its outline steps as well, on one side and far
  for (const double height : {0.2, 0.3, 0.42}) {
    Scene scene;
    scene.boxes = {upright(-0.15, 2.9, 0, {0.3, 0.3, 0.5}, 0), upright(0.15, 2.9, 0, {0.3, 0.3, height}, 0)};
    scene.height = 0.7;
    scene.pitch = radians(8.0);
    scene.noise = 0.0015;
    EXPECT_TRUE(levels(observed(scene)).empty()) << height;
  }
}

/// Boxes of unlike height whose fronts are not in line: a slab with boxes on it would nearly explain them too.
TEST(StackLevels, ARowIsPartedByWalls) {
  for (const double yaw : {-20.0, -1.0, 12.0})
    for (const double noise : {0.0005, 0.0015}) {
      const auto at = [&](double across, double in, const Vec3& size) {
        const Vec2 p = Vec2(0, 1.56) + Eigen::Rotation2Dd(radians(yaw)) * Vec2(across, in + 0.5 * size.y());
        return upright(p.x(), p.y(), 0, size, yaw);
      };
      Scene scene;
      scene.boxes = {at(-0.303, 0.01, {0.31, 0.36, 0.2}), at(0, 0.045, {0.29, 0.39, 0.44}), at(0.299, 0, {0.304, 0.265, 0.2})};
      scene.height = 1.5;
      scene.pitch = radians(37.0);
      scene.noise = noise;
      const Observation seen = observed(scene);
      const Stacks stacks = find_stacks(seen, {all_points_of_objects(seen)}, Context());
      ASSERT_EQ(stacks.stack_of_piece.size(), 1 + scene.boxes.size()) << yaw << " " << noise;
      std::size_t count = 0, right = 0;
      for (std::size_t i = 0; i < seen.points.size(); ++i) {
        const int piece = stacks.piece_of_point[i];
        if (piece == 0) continue;
        const auto& box = scene.boxes[static_cast<std::size_t>(piece - 1)];
        ++count;
        right += std::abs(box.axes.col(0).dot(seen.points[i] - box.center)) < box.half_size.x() + 0.01;
      }
      EXPECT_GT(static_cast<double>(right), 0.98 * static_cast<double>(count)) << yaw << " " << noise;
    }
}

TEST(StackLevels, OneBoxHasNone) {
  for (const double yaw : {0.0, 25.0, 44.0}) {
    Scene scene;
    scene.boxes = {upright(0, 1.2, 0, {0.3, 0.26, 0.44}, yaw)};
    scene.height = 0.9;
    EXPECT_TRUE(levels(observed(scene)).empty()) << yaw;
  }
}

TEST(StackLevels, WhatLeansHasNone) {  // though boxes like stairs explain a leaning one better than an upright box does
  for (const double lean : {5.0, 12.0, 20.0}) {
    Scene scene;
    OrientedBox plank = upright(0, 1.2, 0.1, {0.25, 0.06, 0.5}, 20);
    plank.axes = plank.axes * Eigen::AngleAxisd(radians(-lean), Vec3::UnitX()).toRotationMatrix();
    scene.boxes = {plank};
    scene.height = 0.9;
    EXPECT_TRUE(levels(observed(scene)).empty()) << lean;
  }
}

TEST(StackLevels, ACrateTurnedALittleOnAnotherIsItsOwn) {
  for (const double turn : {6.0, 10.0, 25.0}) {
    Scene scene;
    scene.boxes = {upright(0, 1.2, 0, {0.3, 0.26, 0.2}, 30), upright(0, 1.2, 0.2, {0.3, 0.26, 0.24}, 30 - turn)};
    scene.height = 1.1;
    expect_boxes(scene, perceive(render(scene)).fitted, 0.02, std::to_string(turn));
  }
}

TEST(StackLevels, ATowerIsAsManyBoxesAsItHas) {
  Scene scene;
  scene.boxes = {upright(0, 1.2, 0, {0.3, 0.28, 0.16}, 30), upright(0, 1.2, 0.16, {0.28, 0.27, 0.2}, 20), upright(0, 1.2, 0.36, {0.29, 0.26, 0.15}, 36)};
  scene.height = 1.2;
  scene.dropout = 1;
  expect_boxes(scene, perceive(render(scene)).fitted, 0.025, "tower");
}

TEST(StackLevels, PiecesAreNotFusedAgain) {
  Scene scene;  // in line but for 6 degrees
  scene.boxes = {upright(0, 1.2, 0, {0.3, 0.26, 0.2}, 30), upright(0, 1.2, 0.2, {0.3, 0.26, 0.24}, 36)};
  scene.height = 1.1;
  const RgbdFrame frame = render(scene);
  Perceived p = perceive(frame);
  const DepthView view(frame, p.seen.T_world_camera, depth_noise(frame, {}));
  std::vector<double> tolerance = contact_tolerance(view, p.fitted);
  EXPECT_EQ(fuse_pieces(view, p.fitted, tolerance), 0u);
  expect_boxes(scene, p.fitted, 0.02, "after");
}

TEST(Boxes, AStripOfATopIsPartOfTheBox) {  // the box on it leaves a frame of 4.5 cm
  Scene scene;
  scene.boxes = {upright(0, 1.7, 0, {0.34, 0.38, 0.25}, 30), upright(0, 1.7, 0.25, {0.25, 0.29, 0.3}, 33)};
  scene.height = 1.32;
  scene.dropout = 1;
  expect_boxes(scene, perceive(render(scene)).fitted, 0.02, "frame");
}

TEST(Boxes, AStripThatRunsOnTellsTheLength) {  // beside a turned box, a narrowing strip of the top is seen to the far edge
  Scene scene;
  scene.boxes = {upright(-0.15, 1.3, 0, {0.3, 0.4, 0.25}, 0), upright(-0.17, 1.3, 0.25, {0.24, 0.3, 0.25}, 12)};
  scene.height = 0.8;
  scene.pitch = radians(28.0);
  const Perceived p = perceive(render(scene));
  const OrientedBox& fitted = nearest(p.fitted, scene.boxes[0].center).box;
  EXPECT_LT(size_error(fitted, scene.boxes[0]), 0.03);
}

TEST(Grooves, PartEqualBoxesSideBySide) {
  for (const double gap : {0.015, 0.025, 0.04}) {
    Scene scene;
    for (const double side : {-1.0, 1.0}) {
      scene.boxes.push_back(upright(0, 1.6, 0, {0.2, 0.25, 0.2}, -35));
      scene.boxes.back().center += side * 0.5 * (0.2 + gap) * scene.boxes.back().axes.col(0);
    }
    scene.height = 1.02;
    scene.dropout = 1;
    const RgbdFrame frame = render(scene);
    Perceived p = perceive(frame);
    const DepthView view(frame, p.seen.T_world_camera, depth_noise(frame, {}));
    std::vector<double> tolerance = contact_tolerance(view, p.fitted);
    fuse_pieces(view, p.fitted, tolerance);
    expect_boxes(scene, p.fitted, 0.02, std::to_string(gap));
  }
}

TEST(Grooves, AreWhereTheyWereSeen) {
  Scene scene;
  for (const double x : {-0.12, 0.12}) scene.boxes.push_back(upright(x, 1.1, 0, {0.2, 0.25, 0.2}, 0));  // 4 cm between them
  scene.height = 0.8;
  const RgbdFrame frame = render(scene);
  Context context;
  const Observation seen = observe(frame, {}, context);
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  const OrientedBox both = upright(0, 1.1, 0, {0.44, 0.25, 0.2}, 0);
  const std::vector<double> found = grooves(view, both, 0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 0.0, 0.006);
  EXPECT_TRUE(grooves(view, both, 1).empty());
  for (const double share : seen_through(view, both, 0, 0.1)) EXPECT_LT(share, 0.1);
  EXPECT_TRUE(grooves(view, scene.boxes[0], 0).empty());
}

TEST(Grooves, BelowAThirdBoxAreAsDeepAsTheyAreWide) {
  for (const bool is_door : {false, true}) {  // of a cupboard: the gap ends 3 cm behind the front
    Scene scene;
    for (const double x : {-0.12, 0.12}) scene.boxes.push_back(upright(x, 1.1, 0, {0.2, 0.25, 0.2}, 0));
    scene.boxes.push_back(upright(0, 1.1, 0.2, {0.44, 0.25, 0.1}, 0));
    if (is_door) scene.boxes.push_back(upright(0, 1.115, 0, {0.1, 0.22, 0.2}, 0));
    scene.height = 0.8;
    const RgbdFrame frame = render(scene);
    Context context;
    const Observation seen = observe(frame, {}, context);
    const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
    EXPECT_EQ(grooves(view, upright(0, 1.1, 0, {0.44, 0.25, 0.2}, 0), 0).size(), is_door ? 0u : 1u) << is_door;
  }
}

TEST(Cuts, APlankThatLeansOnACrateIsOneBox) {
  Scene scene;
  const OrientedBox crate = upright(0, 1.1, 0, {0.3, 0.26, 0.26}, -30);
  OrientedBox plank;  // its lower end on the ground, its lower side against the upper edge of the crate
  plank.half_size = {0.21, 0.065, 0.015};
  const double slope = radians(50.0);
  plank.axes = crate.axes * Eigen::AngleAxisd(slope, Vec3::UnitY()).toRotationMatrix();  // the first points down along the plank
  const Vec3 edge = crate.center + crate.axes * Vec3(0.15, 0, 0.13), foot = edge + 0.26 / std::sin(slope) * plank.axes.col(0);
  plank.center = foot - 0.21 * plank.axes.col(0) + 0.015 * plank.axes.col(2);
  scene.boxes = {crate, plank};
  scene.height = 0.9;
  expect_boxes(scene, perceive(render(scene)).fitted, 0.02, "plank");
}

TEST(Cuts, PlanksThatLeanOnACrateAreOneBoxEach) {  // three of them, and a box on the crate
  for (const int number : {0, 1, 2, 4}) {
    SynthView view = view_of("leaning", number);
    view.masks.clear();
    const Perceived p = perceive(frame_of(view));
    EXPECT_GE(p.fitted.size(), view.truth.cuboids.size()) << number;
    EXPECT_LE(p.fitted.size(), view.truth.cuboids.size() + 1) << number;
  }
}

}  // namespace
}  // namespace unseen::cuboids::test
