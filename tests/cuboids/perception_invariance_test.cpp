// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "perception_scenes.h"
#include "unseen/core/error.h"

namespace unseen::cuboids::test {
namespace {

Scene clutter() {
  Scene scene;
  scene.boxes = {upright(-0.2, 0.8, 0, {0.26, 0.2, 0.06}, 5), upright(-0.19, 0.81, 0.06, {0.15, 0.12, 0.07}, 40),
                 upright(0.2, 0.7, 0, {0.1, 0.06, 0.2}, -20), upright(0.25, 1.0, 0, {0.2, 0.15, 0.1}, 60)};
  return scene;
}

TEST(Invariance, SameBytesAtAnyThreadCount) {
  const RgbdFrame frame = render(clutter());
  const Perceived one = perceive(frame, {}, 1);
  for (const int threads : {2, 4}) {
    const Perceived more = perceive(frame, {}, threads);
    ASSERT_EQ(more.cuboids.size(), one.cuboids.size());
    for (std::size_t k = 0; k < one.cuboids.size(); ++k) {
      EXPECT_EQ(more.cuboids[k].box.center, one.cuboids[k].box.center);
      EXPECT_EQ(more.cuboids[k].box.half_size, one.cuboids[k].box.half_size);
      EXPECT_EQ(more.cuboids[k].box.axes, one.cuboids[k].box.axes);
    }
  }
}

TEST(Invariance, AMirroredPictureGivesMirroredBoxes) {
  const RgbdFrame frame = render(clutter());
  RgbdFrame mirrored = frame;
  const int w = frame.camera.width;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const std::size_t j = i / w * w + (w - 1 - i % w);
    mirrored.depth[j] = frame.depth[i];
    mirrored.color[j] = frame.color[i];
  }
  const Perceived a = perceive(frame), b = perceive(mirrored);
  ASSERT_EQ(a.cuboids.size(), 4u);
  ASSERT_EQ(b.cuboids.size(), 4u);
  for (const Cuboid& cuboid : a.fitted) {
    const Vec3 there = cuboid.box.center.cwiseProduct(Vec3(-1, 1, 1));
    const OrientedBox& box = nearest(b.fitted, there).box;
    EXPECT_LT((box.center - there).norm(), 0.003);
    EXPECT_LT(size_error(box, cuboid.box), 0.004);
  }
}

TEST(Invariance, ScalingDepthAndNoiseScalesTheBoxes) {
  const RgbdFrame frame = render(clutter());
  RgbdFrame large = frame;
  for (float& depth : large.depth) depth *= 3.0f;
  Options options;
  options.noise = depth_noise(frame, {}) / 3.0;  // σ grows with the square of the depth
  const Perceived a = perceive(frame), b = perceive(large, options);
  ASSERT_EQ(a.fitted.size(), b.fitted.size());
  for (const Cuboid& cuboid : a.fitted) {
    const OrientedBox& box = nearest(b.fitted, 3.0 * cuboid.box.center).box;
    EXPECT_LT((box.center - 3.0 * cuboid.box.center).norm(), 0.01);
    OrientedBox tripled = cuboid.box;
    tripled.half_size *= 3.0;
    EXPECT_LT(size_error(box, tripled), 0.018);
  }
}

TEST(Invariance, ATurnAboutGravityTurnsTheBoxes) {
  for (const double turn : {30.0, 75.0, 160.0}) {
    Scene scene;
    const Vec3 pivot(0.0, 0.8, 0.0);
    const Mat3 rotation = Eigen::AngleAxisd(radians(turn), Vec3::UnitZ()).toRotationMatrix();
    scene.boxes = {upright(-0.15, 0.8, 0, {0.2, 0.15, 0.1}, 5), upright(-0.15, 0.8, 0.1, {0.1, 0.07, 0.06}, 35),
                   upright(0.18, 0.8, 0, {0.1, 0.12, 0.12}, -20)};
    for (OrientedBox& box : scene.boxes) {
      box.center = rotation * (box.center - pivot) + pivot;
      box.axes = rotation * box.axes;
    }
    scene.pitch = radians(45.0);
    scene.height = 0.9;
    const Perceived p = perceive(render(scene));
    ASSERT_EQ(p.fitted.size(), 3u) << turn;
    for (const OrientedBox& box : scene.boxes) EXPECT_LT(size_error(nearest(p.fitted, box.center).box, box), 0.012) << turn;
  }
}

TEST(Invariance, AShuffledCloudGivesTheSameBoxes) {
  const Scene scene = clutter();
  const RgbdFrame image = render(scene);
  RgbdFrame cloud;
  cloud.name = "cloud";
  const RigidTransform T = camera_of(scene);
  for (std::size_t i = 0; i < image.depth.size(); i += 2)
    cloud.cloud.positions.push_back(T * image.camera.unproject(static_cast<double>(i % 640), static_cast<double>(i / 640), image.depth[i]));
  cloud.cloud.viewpoint = T.translation;
  cloud.up = Vec3::UnitZ();
  const Perceived a = perceive(cloud);
  Random random(3);
  for (std::size_t i = cloud.cloud.positions.size(); i > 1; --i) std::swap(cloud.cloud.positions[i - 1], cloud.cloud.positions[random.index(i)]);
  const Perceived b = perceive(cloud);
  ASSERT_EQ(a.fitted.size(), 4u);
  ASSERT_EQ(b.fitted.size(), 4u);
  EXPECT_NEAR(a.seen.T_world_camera.translation.z(), scene.height, 0.002);
  for (const OrientedBox& truth : scene.boxes) {
    EXPECT_LT(size_error(nearest(a.fitted, truth.center).box, truth), 0.015);
    EXPECT_LT((nearest(a.fitted, truth.center).box.center - nearest(b.fitted, truth.center).box.center).norm(), 0.004);
  }
}

TEST(BadInput, IsRefusedInWords) {
  RgbdFrame frame = render(clutter());
  RgbdFrame empty = frame;
  empty.depth.assign(frame.depth.size(), 0.0f);
  EXPECT_THROW(perceive(empty), InputError);
  empty.depth.clear();
  EXPECT_THROW(perceive(empty), InputError);
  RgbdFrame millimetres = frame;
  for (float& depth : millimetres.depth) depth *= 1000.0f;
  EXPECT_THROW(perceive(millimetres), InputError);
  RgbdFrame blind = frame;
  blind.camera.fx = 0;
  EXPECT_THROW(perceive(blind), InputError);
  RgbdFrame narrow = frame;
  narrow.color.resize(100);
  EXPECT_THROW(perceive(narrow), InputError);
  RgbdFrame noise = frame;  // no plane at all
  Random random(5);
  for (float& depth : noise.depth) depth = static_cast<float>(random.uniform(0.5, 5.0));
  EXPECT_THROW(perceive(noise), InputError);
}

TEST(BadInput, AnUpsideDownUpIsNoticed) {
  const Scene scene = clutter();
  RgbdFrame frame = render(scene);
  frame.up = camera_of(scene).rotation.row(2).transpose();
  EXPECT_EQ(perceive(frame).cuboids.size(), 4u);
  frame.up = -*frame.up;
  try {
    perceive(frame);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field, "up");
  }
}

/// cx and cy of 0, as files have that left them out; and a middle that is a little off, as lenses have it.
TEST(BadInput, AMiddleFarOffThePicturesIsSaid) {
  Scene scene;
  scene.boxes = {upright(0, 0.8, 0, {0.3, 0.2, 0.15}, 20)};
  RgbdFrame frame = render(scene);
  frame.camera.cx += 20.0;
  Context context;
  observe(frame, {}, context);
  EXPECT_TRUE(context.take_warnings().empty());
  frame.camera.cx = 0.0;
  observe(frame, {}, context);
  const std::vector<std::string> warnings = context.take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("cx = 0 and cy = 239.5"), std::string::npos) << warnings[0];
}

TEST(BadInput, NothingOnTheGroundIsNoObject) {
  Scene scene;
  EXPECT_TRUE(perceive(render(scene)).cuboids.empty());
}

TEST(BadInput, ObjectsCutByTheBorderAreBoxedAsFarAsSeen) {
  Scene scene;
  scene.boxes = {upright(-0.55, 0.75, 0, {0.3, 0.2, 0.12}, 0)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.cuboids.size(), 1u);
  EXPECT_NEAR(2.0 * p.fitted[0].box.half_size.z(), 0.12, 0.004);
  EXPECT_LT(2.0 * p.fitted[0].box.half_size.x(), 0.3);
}

TEST(Perception, FindsTwoHundredObjects) {
  Scene scene;
  scene.height = 1.5;
  scene.pitch = radians(60.0);
  for (int i = 0; i < 200; ++i)
    scene.boxes.push_back(upright(-0.855 + 0.09 * (i % 20), 0.4 + 0.1 * (i / 20), 0, {0.05, 0.05, 0.04}, 7.0 * i));
  const Perceived p = perceive(render(scene));
  EXPECT_GE(p.cuboids.size(), 195u);
  EXPECT_LE(p.cuboids.size(), 205u);
}

}  // namespace
}  // namespace unseen::cuboids::test
