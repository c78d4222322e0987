// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "cuboids/objects/slabs.h"
#include "perception_scenes.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

/// A plank on two blocks, flush in front: one connected surface, and free space between the blocks.
Scene bridge() {
  Scene scene;
  scene.boxes = {upright(-0.165, 0.9, 0, {0.17, 0.12, 0.12}, 0), upright(0.165, 0.9, 0, {0.17, 0.12, 0.12}, 0),
                 upright(0, 0.9, 0.12, {0.5, 0.12, 0.04}, 0)};
  return scene;
}

void expect_boxes_of_bridge(const std::vector<Cuboid>& cuboids) {
  for (const OrientedBox& box : bridge().boxes)
    EXPECT_TRUE(std::any_of(cuboids.begin(), cuboids.end(), [&](const Cuboid& cuboid) {
      const Vec3 size = 2.0 * (cuboid.initial.half_size - box.half_size), place = cuboid.initial.center - box.center;
      return std::hypot(size.x(), size.z()) < 0.02 && std::hypot(place.x(), place.z()) < 0.02;
    }));
}

TEST(Cuts, APlankIsPartedFromTheBlocksThatCarryIt) {
  const RgbdFrame frame = render(bridge());
  const Perceived p = perceive(frame);
  expect_boxes_of_bridge(p.fitted);
  const DepthView view(frame, p.seen.T_world_camera, depth_noise(frame, {}));
  for (const Cuboid& cuboid : p.fitted) EXPECT_GT(filled_share(view, cuboid.box, 0.005), 0.9);
}

TEST(Cuts, ASmallBoxFlushWithACornerOfALargeOneIsItsOwn) {  // the step is what tells
  Scene scene;
  scene.boxes = {upright(0, 0.8, 0, {0.3, 0.25, 0.1}, 30), upright(0, 0.8, 0.1, {0.12, 0.12, 0.06}, 30)};
  scene.boxes[1].center += scene.boxes[0].axes * Vec3(-0.09, -0.065, 0);
  scene.pitch = radians(45.0);
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 2u);
  for (const OrientedBox& box : scene.boxes) EXPECT_LT(size_error(nearest(p.fitted, box.center).box, box), 0.02);
}

TEST(Cuts, ARoundThingStaysWhole) {  // a twelve-sided column leaves a fifth of its box free, and nothing of its hull
  Scene scene;
  const double radius = 0.07;
  for (int k = 0; k < 6; ++k)
    scene.boxes.push_back(upright(0, 0.8, 0, {2.0 * radius * std::cos(radians(15.0)), 2.0 * radius * std::sin(radians(15.0)), 0.18}, 30.0 * k));
  EXPECT_EQ(perceive(render(scene)).parts.size(), 1u);
}

TEST(Cuts, WhatAMaskNamesIsCutTooAndOneBody) {
  RgbdFrame frame = render(bridge());
  for (const auto& c : frame.color) frame.masks.push_back(c[2] != 0 ? 1 : 0);
  Context context;
  const Completion found = complete_cuboids(frame, Options{}, context);
  ASSERT_EQ(found.cuboids.size(), 3u);
  expect_boxes_of_bridge(found.cuboids);
  for (const Cuboid& cuboid : found.cuboids) EXPECT_EQ(cuboid.object, found.cuboids.front().object);
}

TEST(Cuts, BoxesTurnedOnEachOtherAreCutOnceEach) {  // in the axes of one, the hull of the other holds little that is free
  Scene scene;
  scene.noise = 0.0008;
  scene.boxes = {upright(0, 0.9, 0, {0.28, 0.24, 0.12}, 5), upright(0, 0.9, 0.12, {0.2, 0.2, 0.12}, 28)};
  const Perceived p = perceive(render(scene));
  EXPECT_EQ(p.fitted.size(), 2u);
}

/// A table turned by 35°, its legs five centimetres wide.
Scene table() {
  Scene scene;
  scene.height = 1.3;
  scene.pitch = radians(38.0);
  scene.noise = 0.002;
  scene.boxes = {upright(-0.05, 1.4, 0.46, {0.7, 0.45, 0.025}, 35)};
  for (const Vec2& side : {Vec2(-1, -1), Vec2(-1, 1), Vec2(1, -1), Vec2(1, 1)}) {
    const Vec3 corner = scene.boxes[0].center + scene.boxes[0].axes * Vec3(0.31 * side.x(), 0.185 * side.y(), 0);
    scene.boxes.push_back(upright(corner.x(), corner.y(), 0, {0.05, 0.05, 0.46}, 35));
  }
  return scene;
}

TEST(Cuts, SlenderLegsAreCutOffATopAndParallelToIt) {  // in their noise no face of a leg tells its direction
  const Scene scene = table();
  int legs = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Perceived p = perceive(render(scene, seed));
    EXPECT_LT(size_error(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 0.04) << seed;
    for (std::size_t k = 1; k < scene.boxes.size(); ++k) {
      const OrientedBox& leg = nearest(p.fitted, scene.boxes[k].center).box;
      const double turn = std::abs(std::remainder(degrees(std::atan2(leg.axes(1, 0), leg.axes(0, 0))) - 35.0, 90.0));
      legs += size_error(leg, scene.boxes[k]) < 0.04 && turn < 5.0;
    }
  }
  EXPECT_GE(legs, 11);  // of sixteen; the far ones are mostly hidden
}

/// A bowl of slats that lean outwards: each of its shards would be a box.
TEST(Cuts, ABowlIsNotCutIntoShards) {
  for (const int slats : {12, 14, 16, 20})
    for (const double lean : {30.0, 50.0}) {
      Scene scene;
      scene.height = 0.6;
      const double radius = 0.1;
      for (int k = 0; k < slats; ++k) {
        const Mat3 turn = Eigen::AngleAxisd(2.0 * kPi * k / slats, Vec3::UnitZ()).toRotationMatrix();
        OrientedBox slat;
        slat.half_size = Vec3(1.25 * radius * std::tan(kPi / slats), 0.005, 0.06);
        slat.axes = turn * Eigen::AngleAxisd(radians(lean), Vec3::UnitX()).toRotationMatrix();
        slat.center = Vec3(0, 0.75, 0.055) - turn * Vec3(0, radius, 0);
        scene.boxes.push_back(slat);
      }
      EXPECT_LE(perceive(render(scene)).parts.size(), 4u) << slats << " " << lean;
    }
}

TEST(Cuts, AnExactBoxStaysWhole) {  // of a few pixels, each far wider than the noise
  Scene scene;
  scene.noise = 0.0;
  scene.boxes = {upright(0.1, 2.5, 0, {0.28, 0.1, 0.57}, 25)};
  scene.height = 1.2;
  scene.pitch = radians(20.0);
  scene.width = 320;
  scene.image_height = 240;
  scene.focal = 260;
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 1u);
  EXPECT_LT(size_error(p.fitted[0].box, scene.boxes[0]), 0.03);
}

}  // namespace
}  // namespace unseen::cuboids::test
