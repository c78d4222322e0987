// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Parts of one box that something before it divides.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "cuboids/search/complete.h"
#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

/// A crate, and a board behind it that leans on its upper edge.
Scene board_on_crate(double lean, double aside) {
  Scene scene;
  scene.height = 1.0;
  scene.pitch = radians(25.0);
  const OrientedBox crate = upright(0.0, 1.6, 0, {0.4, 0.4, 0.4}, 0);
  OrientedBox board;
  board.half_size = Vec3(0.2, 0.01, 0.3);
  board.axes = Eigen::AngleAxisd(radians(lean), Vec3::UnitX()).toRotationMatrix();
  const Vec3 edge(aside, 1.8, 0.4), up = board.axes.col(2), front = -board.axes.col(1);
  const Vec3 foot = edge - up * (edge.z() / up.z());
  board.center = foot + up * 0.3 - front * 0.01;
  const double yaw = radians(aside < 0.0 ? 30.0 : -30.0);
  const Mat3 turn = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 about(0, 1.6, 0);
  scene.boxes = {crate, board};
  for (OrientedBox& box : scene.boxes) {
    box.axes = turn * box.axes;
    box.center = about + turn * (box.center - about);
  }
  return scene;
}

/// What is left of a crate, fitted too deep by so much (m), and the two parts of a board that are seen above and beside it.
std::vector<Cuboid> fused(const Scene& scene, double aside, double too_deep, const std::array<std::optional<Vec2>, 2>& tints = {}) {
  const RgbdFrame frame = render(scene);
  Context context;
  const Observation seen = observe(frame, {}, context);
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  const OrientedBox &crate = scene.boxes[0], &board = scene.boxes[1];
  std::vector<Cuboid> cuboids(3);
  cuboids[0].initial = crate;
  cuboids[0].initial.half_size.y() += 0.5 * too_deep;
  cuboids[0].initial.center += 0.5 * too_deep * crate.axes.col(1);
  const double edge = 0.4 / board.axes(2, 2) - 0.3;  // along the board, from its middle
  const double side = aside < 0.0 ? -1.0 : 1.0;
  cuboids[1].initial = cuboids[2].initial = board;
  cuboids[1].initial.half_size.z() = 0.5 * (0.3 - edge);
  cuboids[1].initial.center += 0.5 * (0.3 + edge) * board.axes.col(2);
  cuboids[2].initial.half_size.z() = 0.5 * (0.3 + edge);
  cuboids[2].initial.half_size.x() = 0.06;
  cuboids[2].initial.center += 0.5 * (edge - 0.3) * board.axes.col(2) + side * 0.14 * board.axes.col(0);
  for (Cuboid& cuboid : cuboids) cuboid.visible_points = 1000;
  for (int k = 0; k < 2; ++k) cuboids[k + 1].tint = tints[k];
  std::vector<double> tolerance = contact_tolerance(view, cuboids);
  fuse_pieces(view, cuboids, tolerance);
  return cuboids;
}

TEST(Fuse, ABoardThatLeansOnACrateAndIsSeenAboveAndBesideItIsOne) {
  for (const double lean : {8.0, 14.0, 20.0})
    for (const double aside : {-0.15, 0.15})
      for (const double too_deep : {0.0, 0.02}) {
        const Scene scene = board_on_crate(lean, aside);
        const std::vector<Cuboid> cuboids = fused(scene, aside, too_deep);
        ASSERT_EQ(cuboids.size(), 2u) << lean << " " << aside << " " << too_deep;
        EXPECT_LT((cuboids[1].initial.half_size - scene.boxes[1].half_size).cwiseAbs().maxCoeff(), 1e-3) << lean << " " << aside << " " << too_deep;
      }
}

TEST(Fuse, WhatHasOtherColoursIsNotOne) {
  const Scene scene = board_on_crate(14.0, 0.15);
  EXPECT_EQ(fused(scene, 0.15, 0.0, {Vec2(30, 10), Vec2(-20, 10)}).size(), 3u);
  EXPECT_EQ(fused(scene, 0.15, 0.0, {Vec2(30, 10), Vec2(27, 9)}).size(), 2u);
  EXPECT_EQ(fused(scene, 0.15, 0.0, {Vec2(30, 10), std::nullopt}).size(), 2u);
}

/// What a box before a plank divides may reach into each other: both parts were fitted too long.
TEST(Fuse, PartsThatOverlapLengthwiseAreOne) {
  Scene scene;
  scene.boxes = {upright(0, 0.9, 0, {0.6, 0.12, 0.05}, 20)};
  const RgbdFrame frame = render(scene);
  Context context;
  const Observation seen = observe(frame, {}, context);
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  const auto after = [&](double overlap) {
    std::vector<Cuboid> cuboids(2);
    for (int k = 0; k < 2; ++k) {
      cuboids[k].initial = scene.boxes[0];
      const double length = k == 0 ? 0.4 : 0.2 + overlap;
      cuboids[k].initial.half_size.x() = 0.5 * length;
      cuboids[k].initial.center += (k == 0 ? 0.5 * length - 0.3 : 0.3 - 0.5 * length) * scene.boxes[0].axes.col(0);
      cuboids[k].visible_points = 1000;
    }
    std::vector<double> tolerance = contact_tolerance(view, cuboids);
    fuse_pieces(view, cuboids, tolerance);
    return cuboids;
  };
  for (const double overlap : {0.0, 0.03, 0.06}) {
    const std::vector<Cuboid> cuboids = after(overlap);
    ASSERT_EQ(cuboids.size(), 1u) << overlap;
    EXPECT_LT((cuboids[0].initial.half_size - scene.boxes[0].half_size).norm(), 1e-9) << overlap;
  }
  EXPECT_EQ(after(0.15).size(), 2u);
}

/// Things over a table's front edge divide what is seen of its top, and seem to end where the top does.
TEST(Fuse, ATableTopBetweenThingsOverItsEdgeIsOne) {
  for (const double yaw : {-15.0, 10.0}) {
    Scene scene;
    scene.height = 1.3;
    scene.pitch = radians(22.0);
    const Vec3 about(0, 1.5, 0);
    const auto put = [&](double x, double y, double z, const Vec3& size, double turn) {
      OrientedBox box = upright(x, y, z, size, turn);
      box.axes = Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()).toRotationMatrix() * box.axes;
      box.center = about + Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()) * (box.center - about);
      scene.boxes.push_back(box);
    };
    put(0, 1.9, 0.72, {1.4, 0.8, 0.03}, 0);
    put(-0.6, 1.9, 0, {0.03, 0.7, 0.72}, 0);
    put(0.6, 1.9, 0, {0.03, 0.7, 0.72}, 0);
    put(-0.45, 1.54, 0.75, {0.2, 0.2, 0.12}, 4);
    put(0.0, 1.55, 0.75, {0.24, 0.22, 0.16}, -5);
    put(0.42, 1.53, 0.75, {0.2, 0.18, 0.13}, 3);
    put(0.0, 1.95, 0.75, {0.3, 0.2, 0.15}, 17);
    Context context;
    const Completion result = complete_cuboids(render(scene), {}, context);
    EXPECT_EQ(result.cuboids.size(), scene.boxes.size()) << yaw;
    for (const OrientedBox& box : scene.boxes) {
      double nearest = 1.0;
      for (const Cuboid& cuboid : result.cuboids)
        if ((cuboid.box.center - box.center).norm() < 0.05) nearest = std::min(nearest, (cuboid.box.half_size - box.half_size).cwiseAbs().maxCoeff());
      EXPECT_LT(nearest, 0.02) << yaw << ": " << box.center.transpose();
    }
  }
}

}  // namespace
}  // namespace unseen::cuboids::test
