// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What cameras see that look at furniture before a wall, or down at things on things.
#include <gtest/gtest.h>

#include "perception_scenes.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

/// The wall is as large as the floor, and touches what stands before it.
TEST(SteepViews, UpIsNotAwayFromTheWallBehindCupboards) {
  for (const double away : {2.0, 2.36})
    for (const double yaw : {-30.0, -20.0})
      for (const double tall : {1.05, 1.4}) {
        Scene scene;
        scene.height = 0.6 + 0.466 * away;
        scene.pitch = radians(25.0);
        const Vec3 about(0, away, 0);
        const Mat3 turn = Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()).toRotationMatrix();
        scene.boxes = {upright(-0.3, away, 0, {1.2, 0.6, 0.85}, 0), upright(0.605, away, 0, {0.6, 0.6, tall}, 0), upright(0, away + 0.37, 0, {8.0, 0.1, 2.6}, 0)};
        for (OrientedBox& box : scene.boxes) box.axes = turn * box.axes, box.center = about + turn * (box.center - about);
        Context context;
        const Vec3 up = observe(render(scene), {}, context).T_world_camera.rotation.row(2).transpose(), truth = camera_of(scene).rotation.row(2).transpose();
        EXPECT_GT(up.dot(truth), 0.99) << away << " m, turned by " << yaw << ", tall " << tall;
      }
}

/// A level camera before a wall sees but a strip of the floor, as one that looks down into a bin sees its side.
TEST(SteepViews, UpIsAwayFromAStripOfFloorBeforeAWall) {
  for (const double wall : {2.9, 3.2, 3.4})
    for (const double noise : {0.0, 0.0015}) {
      Scene scene;
      scene.height = 1.3 + 0.4 * (wall - 2.9);
      scene.pitch = radians(2.0);
      scene.noise = noise;
      scene.boxes = {upright(-0.1, wall - 0.5, 0, {0.8, 0.5, 1.9}, -10), upright(0.5, wall - 0.75, 0, {0.4, 0.3, 0.3}, 10), upright(0, wall, 0, {8.0, 0.1, 3.0}, -10)};
      Context context;
      const Vec3 up = observe(render(scene), {}, context).T_world_camera.rotation.row(2).transpose(), truth = camera_of(scene).rotation.row(2).transpose();
      EXPECT_GT(up.dot(truth), 0.99) << wall << " m, noise " << noise;
    }
}

/// The wall at the picture's lower border is as a strip of floor; but things stand on what fills the picture.
TEST(SteepViews, UpIsThatOfTheFloorBesideAWallThatIsSeenFromAbove) {
  for (const double height : {2.5, 3.0})
    for (const double pitch : {85.0, 90.0}) {
      Scene scene;
      scene.height = height;
      scene.pitch = radians(pitch);
      const double border = height / std::tan(radians(pitch + 24.0));
      scene.boxes = {upright(0, border, 0, {8.0, 0.1, 0.9 * height}, 0), upright(-0.3, 0.1, 0, {0.3, 0.2, 0.2}, 20), upright(0.35, 0.3, 0, {0.25, 0.25, 0.3}, -15),
                     upright(0.1, -0.15, 0, {0.2, 0.3, 0.15}, 40)};
      Context context;
      const Vec3 up = observe(render(scene), {}, context).T_world_camera.rotation.row(2).transpose(), truth = camera_of(scene).rotation.row(2).transpose();
      EXPECT_GT(up.dot(truth), 0.99) << height << " m, " << pitch;
    }
}

/// Straight down into a bin, or level into a shelf: nothing in the picture tells.
TEST(SteepViews, UpIsDoubtedWhereTheCameraLooksStraightIntoABin) {
  for (const double pitch : {35.0, 88.0}) {
    Scene scene;
    scene.height = 0.8;
    scene.pitch = radians(pitch);
    scene.noise = 0.0005;
    const double y = scene.height / std::tan(scene.pitch);
    scene.boxes = {upright(0, y, 0, {0.62, 0.62, 0.02}, 0), upright(0, y - 0.3, 0.02, {0.62, 0.02, 0.3}, 0), upright(0, y + 0.3, 0.02, {0.62, 0.02, 0.3}, 0),
                   upright(-0.3, y, 0.02, {0.02, 0.58, 0.3}, 0), upright(0.3, y, 0.02, {0.02, 0.58, 0.3}, 0), upright(0.05, y, 0.02, {0.2, 0.15, 0.1}, 20)};
    Context context;
    observe(render(scene), {}, context);
    const std::vector<std::string> warnings = context.take_warnings();
    const auto told = std::count_if(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("give it as \"up\"") != std::string::npos; });
    EXPECT_EQ(told, pitch > 80.0 ? 1 : 0) << pitch;
  }
}

/// Of a crate under a box turned across it no more than the corners of its top are seen.
TEST(SteepViews, TheCornersThatLookOutUnderABoxTurnedAcrossAreOfOneCrate) {
  int whole = 0;
  for (const double turn : {35.0, 45.0}) {
    Scene scene;
    scene.height = 1.6;
    scene.pitch = radians(68.0);
    scene.boxes = {upright(0, 0.62, 0, {0.4, 0.36, 0.2}, 5), upright(0, 0.62, 0.2, {0.4, 0.3, 0.14}, 5.0 + turn)};
    Context context;
    const Completion result = complete_cuboids(render(scene), {}, context);
    const OrientedBox& found = nearest(result.cuboids, scene.boxes[0].center).box;
    whole += result.cuboids.size() == 2 && size_error(found, scene.boxes[0]) < 0.02;
  }
  EXPECT_EQ(whole, 2);
}

/// What stands on a black box seems to go down to the floor.
TEST(SteepViews, WhatStandsOnSomethingThatWasNotMeasuredIsDoubted) {
  Scene scene;
  scene.boxes = {upright(0, 0.8, 0, {0.3, 0.25, 0.15}, 20), upright(0, 0.8, 0.15, {0.2, 0.15, 0.1}, 20)};
  const auto doubts = [](const RgbdFrame& frame) {
    Context context;
    const Completion result = complete_cuboids(frame, {}, context);
    const auto& warnings = result.summary.warnings;
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("nothing was measured below") != std::string::npos; });
  };
  RgbdFrame frame = render(scene);
  EXPECT_EQ(doubts(frame), 0);
  const RigidTransform T = camera_of(scene);
  for (int v = 0; v < scene.image_height; ++v)
    for (int u = 0; u < scene.width; ++u) {
      float& depth = frame.depth[static_cast<std::size_t>(v) * scene.width + u];
      const OrientedBox& black = scene.boxes[0];
      const Vec3 p = T * frame.camera.unproject(u, v, depth), off = (black.axes.transpose() * (p - black.center)).cwiseAbs() - black.half_size;
      if (off.maxCoeff() < 0.008 && p.z() > 0.008) depth = 0.0f;
    }
  EXPECT_EQ(doubts(frame), 1);
}

}  // namespace
}  // namespace unseen::cuboids::test
