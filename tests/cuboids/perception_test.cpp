// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "perception_scenes.h"
#include "unseen/core/error.h"

namespace unseen::cuboids::test {
namespace {

TEST(Supports, GroundLiesWithinItsStandardError) {
  Scene scene;
  scene.boxes = {upright(0.05, 0.8, 0, {0.1, 0.1, 0.1}, 20)};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RgbdFrame frame = render(scene, seed);
    Context context;
    const Observation seen = observe(frame, {}, context);
    ASSERT_EQ(seen.supports.size(), 1u);
    EXPECT_EQ(seen.supports[0].kind, SupportKind::ground);
    EXPECT_NEAR(seen.supports[0].plane.offset, 0.0, 1e-9);
    // 1/z = s·ray with noise of the same σ everywhere: covariance of s is σ²(Σ ray rayᵀ)⁻¹; at most 15000 rays are used.
    Mat3 normal_matrix = Mat3::Zero();
    double count = 0;
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      if (seen.support_of_point[i] != 0) continue;
      const int pixel = seen.pixel_of_point[i];
      const Vec3 ray = frame.camera.unproject(pixel % scene.width, pixel / scene.width, 1.0);
      normal_matrix += ray * ray.transpose();
      ++count;
    }
    const Mat3 covariance = scene.noise * scene.noise * (count / 10000.0) * normal_matrix.inverse();
    const RigidTransform T = camera_of(scene);
    const Vec3 s = -T.rotation.row(2).transpose() / scene.height;
    const Vec3 gradient = -s / std::pow(s.norm(), 3);
    const double height_error = std::sqrt(gradient.dot(covariance * gradient));
    EXPECT_LT(height_error, 1e-3);
    EXPECT_NEAR(seen.T_world_camera.translation.z(), scene.height, 4.0 * height_error);
    const double tilt = line_angle(seen.T_world_camera.rotation.row(2).transpose(), T.rotation.row(2).transpose());
    EXPECT_LT(tilt, 4.0 * std::sqrt(covariance.trace()) / s.norm());
    EXPECT_NEAR(seen.T_world_camera.translation.x(), 0.0, 1e-9);
    EXPECT_NEAR(seen.T_world_camera.translation.y(), 0.0, 1e-9);
    EXPECT_TRUE(seen.T_world_camera.is_rigid(1e-9));
  }
}

TEST(Supports, LeaveTheLowestSliceOfThinThings) {
  Scene scene;
  scene.boxes = {upright(0.0, 0.7, 0, {0.2, 0.15, 0.012}, 10)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.cuboids.size(), 1u);
  EXPECT_NEAR(2.0 * p.fitted[0].box.half_size.z(), 0.012, 0.002);
  EXPECT_LT(size_error(p.fitted[0].box, scene.boxes[0]), 0.006);
}

TEST(Supports, GivenOnesAreTaken) {
  Scene scene;
  scene.boxes = {upright(0.0, 0.8, 0, {0.1, 0.1, 0.1}, 0)};
  RgbdFrame frame = render(scene);
  const RigidTransform T = camera_of(scene);
  frame.supports = {{{T.rotation.row(2).transpose(), -scene.height}, "ground"}};
  const Perceived p = perceive(frame);
  EXPECT_LT((p.seen.T_world_camera.rotation - T.rotation).norm(), 1e-9);
  EXPECT_LT((p.seen.T_world_camera.translation - T.translation).norm(), 1e-9);
  EXPECT_EQ(p.cuboids.size(), 1u);
  frame.supports[0].kind = "sofa";
  EXPECT_THROW(perceive(frame), InputError);
}

TEST(Supports, AWallBehindTheThingsIsOne) {
  Scene scene;
  scene.pitch = radians(20.0);
  scene.boxes = {upright(0.0, 0.9, 0, {0.2, 0.1, 0.15}, 0), upright(0.0, 1.55, 0, {4.0, 0.1, 3.0}, 0)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.seen.supports.size(), 2u);
  EXPECT_EQ(p.seen.supports[1].kind, SupportKind::wall);
  EXPECT_NEAR(p.seen.supports[1].plane.signed_distance(Vec3(0, 1.5, 0.3)), 0.0, 0.003);
  EXPECT_LT(p.seen.supports[1].plane.normal.y(), -0.999);
  EXPECT_EQ(p.cuboids.size(), 1u);
}

TEST(Boxes, RecoverSizesAndYaw) {
  for (const double yaw : {-40.0, 5.0, 25.0, 70.0}) {
    Scene scene;
    scene.boxes = {upright(0.03, 0.75, 0, {0.2, 0.12, 0.15}, yaw)};
    const Perceived p = perceive(render(scene));
    ASSERT_EQ(p.fitted.size(), 1u) << yaw;
    EXPECT_LT(turn_between(p.fitted[0].box, scene.boxes[0]), 1.0) << yaw;
    EXPECT_LT(size_error(p.fitted[0].box, scene.boxes[0]), 0.005) << yaw;
    EXPECT_LT((p.fitted[0].box.center - scene.boxes[0].center).norm(), 0.004) << yaw;
  }
}

TEST(Boxes, SeenFromFarAboveKeepTheirSides) {  // noise makes small faces out of their tops' rims
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene scene;
    scene.height = 2.4;
    scene.pitch = radians(80.0);
    scene.boxes = {upright(0.1, 0.45, 0, {0.25, 0.2, 0.2}, 30)};
    const Perceived p = perceive(render(scene, seed));
    ASSERT_EQ(p.fitted.size(), 1u) << seed;
    Vec3 sides = 2.0 * p.fitted[0].box.half_size;
    std::sort(sides.data(), sides.data() + 2);
    EXPECT_NEAR(sides[0], 0.2, 0.03) << seed;
    EXPECT_NEAR(sides[1], 0.25, 0.03) << seed;
  }
}

/// From one pixel to the next such a top runs away by ten times what pixels lie apart, and far more than a precise sensor's noise.
TEST(Boxes, SeenAlmostFromTheSideKeepTheirTops) {
  for (const double above : {0.06, 0.09, 0.12}) {
    Scene scene;
    scene.height = 0.15 + above;
    scene.pitch = radians(12.0);
    scene.noise = 0.0005;
    scene.boxes = {upright(-0.15, 0.85, 0, {0.2, 0.15, 0.15}, 10), upright(0.15, 0.9, 0, {0.15, 0.2, 0.15}, -15)};
    const Perceived p = perceive(render(scene));
    ASSERT_EQ(p.fitted.size(), 2u) << above;
    for (const Cuboid& c : p.fitted) {
      const OrientedBox& truth = scene.boxes[c.box.center.x() < 0 ? 0 : 1];
      EXPECT_LT(size_error(c.box, truth), above < 0.08 ? 0.015 : 0.01) << above;  // the first is seen at 4°
      EXPECT_LT(turn_between(c.box, truth), 2.0) << above;
    }
  }
}

TEST(Boxes, FarAwayAreNotTiltedByNoise) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scene scene;
    scene.height = 1.9;
    scene.pitch = radians(30.0);
    for (int i = 0; i < 5; ++i) scene.boxes.push_back(upright(-0.9 + 0.45 * i, 3.2 + 0.1 * (i % 2), 0, {0.2, 0.15, 0.15}, 13.0 * i + 7.0 * static_cast<double>(seed)));
    for (const Cuboid& cuboid : perceive(render(scene, seed)).cuboids) EXPECT_GT(cuboid.box.axes(2, 2), std::cos(radians(3.0))) << seed;
  }
}

TEST(Boxes, StackedOnesAreSeparated) {
  Scene scene;
  scene.boxes = {upright(0.0, 0.75, 0, {0.26, 0.2, 0.06}, 5), upright(0.01, 0.76, 0.06, {0.15, 0.12, 0.07}, 40)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 2u);
  for (const OrientedBox& truth : scene.boxes) {
    const OrientedBox& box = nearest(p.fitted, truth.center).box;
    EXPECT_LT(size_error(box, truth), 0.008);
    EXPECT_LT(turn_between(box, truth), 1.5);
  }
}

TEST(Boxes, OneThatHangsOverTheEdgeOfATableIsWhole) {
  Scene scene;
  scene.ground_end = 1.0;
  scene.boxes = {upright(0.05, 0.97, 0, {0.15, 0.2, 0.1}, 10), upright(-0.3, 0.8, 0, {0.1, 0.1, 0.1}, 30)};
  Scene with_floor = scene;  // below the table
  with_floor.boxes.push_back(upright(0, 4, -0.8, {8, 8, 0.1}, 0));
  for (const std::uint64_t seed : {1, 2}) {
    const Perceived p = perceive(render(with_floor, seed));
    ASSERT_EQ(p.cuboids.size(), 2u);
    ASSERT_FALSE(p.seen.supports[0].outline.empty());
    for (const OrientedBox& truth : scene.boxes) EXPECT_LT(size_error(nearest(p.fitted, truth.center).box, truth), 0.008) << seed;
  }
}

TEST(Boxes, OneSplitByAnOccluderGivesTwoPartsOfOneTurn) {
  Scene scene;
  scene.boxes = {upright(0.0, 0.9, 0, {0.4, 0.1, 0.1}, 8), upright(0.0, 0.6, 0, {0.1, 0.05, 0.3}, 8)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 3u);
  const OrientedBox &left = nearest(p.fitted, {-0.13, 0.88, 0.05}).box, &right = nearest(p.fitted, {0.13, 0.92, 0.05}).box;
  EXPECT_LT(turn_between(left, right), 1.5);
  EXPECT_LT(turn_between(left, scene.boxes[0]), 1.5);
  EXPECT_NEAR(left.center.z() + left.half_size.z(), right.center.z() + right.half_size.z(), 0.002);
  EXPECT_LT(left.center.x(), right.center.x());
}

TEST(Boxes, WhatIsHiddenIsNotGuessed) {
  Scene scene;  // only the upper part of the box behind shows
  scene.boxes = {upright(0.0, 0.62, 0, {0.25, 0.06, 0.15}, 0), upright(0.0, 0.8, 0, {0.1, 0.08, 0.2}, 0)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 2u);
  const OrientedBox& box = nearest(p.fitted, {0, 0.8, 0.15}).box;
  EXPECT_NEAR(box.center.z() + box.half_size.z(), 0.2, 0.003);
  EXPECT_GT(box.center.z() - box.half_size.z(), 0.03);
}

TEST(Boxes, ASlantedOneGetsItsOwnAxes) {
  Scene scene;
  OrientedBox plank = upright(0, 0, 0, {0.2, 0.3, 0.04}, 0);
  plank.axes = Eigen::AngleAxisd(radians(30.0), Vec3::UnitX()).toRotationMatrix();
  plank.center = Vec3(0.0, 0.8, 0.12);
  scene.boxes = {plank};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 1u);
  EXPECT_LT(degrees(line_angle(p.fitted[0].box.axes.col(2), plank.axes.col(2))), 1.0);
  EXPECT_LT(size_error(p.fitted[0].box, plank), 0.01);
}

TEST(Boxes, ALongOneThatLeansALittleLeansSo) {
  for (const double lean : {0.0, 4.0, 8.0}) {
    Scene scene;
    OrientedBox plank = upright(0, 0.8, 0.06, {0.5, 0.07, 0.035}, 25.0);
    plank.axes = plank.axes * Eigen::AngleAxisd(radians(lean), Vec3::UnitY()).toRotationMatrix();
    scene.boxes = {plank};
    const Perceived p = perceive(render(scene));
    ASSERT_EQ(p.fitted.size(), 1u) << lean;
    EXPECT_LT(degrees(line_angle(p.fitted[0].box.axes.col(2), plank.axes.col(2))), 1.0) << lean;
    if (lean == 0.0) {
      EXPECT_EQ(p.fitted[0].box.axes(2, 2), 1.0);  // level, not nearly so
    }
  }
}

TEST(Boxes, AnLShapedThingBecomesTwoSlabsOutOfFreeSpace) {
  Scene scene;
  scene.boxes = {upright(-0.05, 0.8, 0, {0.1, 0.1, 0.2}, 0), upright(0.05, 0.8, 0, {0.1, 0.1, 0.05}, 0)};
  RgbdFrame frame = render(scene);
  frame.masks.assign(frame.depth.size(), 0);
  Context context;
  const Observation seen = observe(frame, {}, context);
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    if (seen.support_of_point[i] < 0) frame.masks[seen.pixel_of_point[i]] = 3;
  frame.densities["3"] = 700;
  const std::vector<ObjectPart> parts = find_objects(frame, seen, {}, context);
  ASSERT_EQ(parts.size(), 1u);
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  for (const std::vector<Cuboid>& fitted : {fit_cuboids(frame, seen, parts, view, {}, context), perceive(frame).fitted}) {  // as it is, and cut before
    ASSERT_EQ(fitted.size(), 2u);
    for (const Cuboid& cuboid : fitted) {
      EXPECT_EQ(cuboid.label, "3");
      EXPECT_EQ(cuboid.density, 700);
      EXPECT_EQ(cuboid.object, fitted.front().object);
      EXPECT_LT(cuboid.box.volume(), 0.1 * 0.1 * 0.2 * 1.2);
    }
  }
}

/// Boxes around the parts, 0 or 1, that `part_of` puts the points of far things into.
template <class PartOf>
std::vector<Cuboid> fit_two_parts(const std::vector<OrientedBox>& boxes, PartOf part_of) {
  Scene scene;
  scene.focal = 300.0;
  scene.height = 1.2;
  scene.boxes = boxes;
  const RgbdFrame frame = render(scene);
  Context context;
  const Observation seen = observe(frame, {}, context);
  std::vector<ObjectPart> parts(2);
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    if (seen.support_of_point[i] < 0) parts[part_of(seen.points[i])].points.push_back(static_cast<int>(i));
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  return fit_cuboids(frame, seen, parts, view, {}, context);
}

TEST(Boxes, AreNotSetDownThroughWhatTheyStandOn) {
  const std::vector<Cuboid> fitted = fit_two_parts({upright(0, 1.7, 0, {0.3, 0.3, 0.025}, 0), upright(0, 1.7, 0.025, {0.12, 0.12, 0.15}, 0)},
                                                   [](const Vec3& p) { return p.z() > 0.035; });
  ASSERT_EQ(fitted.size(), 2u);
  EXPECT_NEAR(fitted[0].box.center.z() - fitted[0].box.half_size.z(), 0.0, 1e-9);
  EXPECT_GT(fitted[1].box.center.z() - fitted[1].box.half_size.z(), 0.02);
}

/// A thing whose end below `cut` (m) went to what lies beside it; together these are too hollow for a box, and each too little.
std::vector<Cuboid> fit_with_end_beside(const std::vector<OrientedBox>& boxes, double cut) {
  return fit_two_parts(boxes, [&](const Vec3& p) { return p.z() < cut || p.x() > 0.1; });
}

TEST(Boxes, AreCarriedDownToTheEndOfWhatIsOfNoBox) {
  const OrientedBox beside = upright(0.3, 1.7, 0, {0.06, 0.06, 0.03}, 0);
  const std::vector<Cuboid> cup = fit_with_end_beside({upright(0, 1.7, 0, {0.08, 0.08, 0.12}, 0), beside}, 0.05);
  ASSERT_EQ(cup.size(), 1u);
  EXPECT_NEAR(cup[0].box.center.z() - cup[0].box.half_size.z(), 0.0, 1e-9);
  EXPECT_NEAR(cup[0].box.half_size.z(), 0.06, 0.005);
  // Not where legs leave free space between them.
  const std::vector<Cuboid> stool = fit_with_end_beside({upright(0, 1.7, 0.1, {0.16, 0.12, 0.06}, 0), upright(-0.07, 1.65, 0, {0.02, 0.02, 0.1}, 0),
                                                         upright(0.07, 1.65, 0, {0.02, 0.02, 0.1}, 0), beside}, 0.1);
  ASSERT_EQ(stool.size(), 1u);
  EXPECT_GT(stool[0].box.center.z() - stool[0].box.half_size.z(), 0.08);
}

TEST(Boxes, ADensityOfNothingInThePictureIsRemarkedOn) {
  Scene scene;
  scene.boxes = {upright(0, 0.8, 0, {0.1, 0.1, 0.1}, 0)};
  RgbdFrame frame = render(scene);
  frame.densities["chair"] = 700;
  Context context;
  const Observation seen = observe(frame, {}, context);
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  fit_cuboids(frame, seen, find_objects(frame, seen, {}, context), view, {}, context);
  const std::vector<std::string> warnings = context.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("\"chair\""), std::string::npos);
}

TEST(Objects, AMaskThatBecomesNoneIsSaid) {
  Scene scene;
  scene.boxes = {upright(0, 0.8, 0, {0.1, 0.1, 0.1}, 0)};
  RgbdFrame frame = render(scene);
  frame.masks.assign(frame.depth.size(), 0);
  Context context;
  const Observation seen = observe(frame, {}, context);
  int rest = 40;
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    frame.masks[seen.pixel_of_point[i]] = seen.support_of_point[i] >= 0 ? 7 : rest-- > 0 ? 5 : 3;  // the ground, a few points of the box, and the box
  const std::vector<ObjectPart> parts = find_objects(frame, seen, {}, context);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].label, "3");
  const std::vector<std::string> warnings = context.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "1 of the masks became no object, too little of them was measured: 5");
}

TEST(Objects, StrokesPartWhatTouches) {
  Scene scene;  // two boxes side by side, flush in front and above: only colour tells them apart
  scene.boxes = {upright(-0.06, 0.75, 0, {0.12, 0.1, 0.1}, 0), upright(0.06, 0.75, 0, {0.12, 0.1, 0.1}, 0)};
  RgbdFrame frame = render(scene);
  RgbdFrame gray = frame;
  gray.color.clear();
  EXPECT_EQ(perceive(gray).fitted.size(), 1u);
  const RigidTransform T = camera_of(scene).inverse();
  for (const double x : {-0.06, 0.06}) {
    Stroke stroke{x < 0 ? "left" : "right", {}};
    for (const double s : {-0.04, 0.0, 0.04}) stroke.points.push_back(frame.camera.project(T * Vec3(x + s, 0.7, 0.05)));
    for (const double s : {0.04, 0.0, -0.04}) stroke.points.push_back(frame.camera.project(T * Vec3(x + s, 0.75, 0.1)));
    frame.strokes.push_back(stroke);
  }
  for (const char* how : {"surface", "grab-cut"}) {
    Options options;
    options.strokes = how;
    const Perceived p = perceive(frame, options);
    ASSERT_EQ(p.fitted.size(), 2u) << how;
    for (std::size_t b = 0; b < 2; ++b) {
      const Cuboid& cuboid = nearest(p.fitted, scene.boxes[b].center);
      EXPECT_EQ(cuboid.label, b == 0 ? "left" : "right") << how;
      EXPECT_LT(size_error(cuboid.box, scene.boxes[b]), 0.012) << how;
    }
  }
}

TEST(Objects, AShortLineEachIsEnough) {
  Scene scene;  // two flush boxes of one height with another upon them; the fourth has no stroke
  scene.boxes = {upright(-0.06, 0.75, 0, {0.12, 0.1, 0.1}, 0), upright(0.06, 0.75, 0, {0.12, 0.1, 0.1}, 0), upright(0.0, 0.75, 0.1, {0.1, 0.1, 0.06}, 0),
                 upright(0.3, 0.75, 0, {0.08, 0.08, 0.12}, 30)};
  RgbdFrame frame = render(scene);
  const RigidTransform T = camera_of(scene).inverse();
  const std::vector<std::string> labels = {"left", "right", "upper"};
  for (std::size_t b = 0; b < 3; ++b) {
    const Vec3 front = scene.boxes[b].center - Vec3(0, scene.boxes[b].half_size.y(), 0);
    frame.strokes.push_back({labels[b], {frame.camera.project(T * (front - Vec3(0.02, 0, 0))), frame.camera.project(T * (front + Vec3(0.02, 0, 0)))}});
  }
  for (int order = 0; order < 2; ++order) {
    const Perceived p = perceive(frame);
    ASSERT_EQ(p.fitted.size(), 4u);
    for (std::size_t b = 0; b < 4; ++b) {
      const Cuboid& cuboid = nearest(p.fitted, scene.boxes[b].center);
      EXPECT_EQ(cuboid.label, b < 3 ? labels[b] : "");
      EXPECT_LT(size_error(cuboid.box, scene.boxes[b]), 0.015) << b;
    }
    std::reverse(frame.strokes.begin(), frame.strokes.end());
  }
  frame.strokes.push_back({"ground", {frame.camera.project(T * Vec3(-0.3, 0.75, 0)), frame.camera.project(T * Vec3(-0.25, 0.75, 0))}});
  Context context;
  find_objects(frame, observe(frame, {}, context), {}, context);
  const std::vector<std::string> warnings = context.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "strokes of \"ground\" touch no object");
}

}  // namespace
}  // namespace unseen::cuboids::test
