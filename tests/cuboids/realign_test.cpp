// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Boxes that were given turned and sized a little wrong.
#include <gtest/gtest.h>

#include "cuboids/complete.h"
#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

Scene two_boxes() {
  Scene scene;  // the lower half of the one behind is hidden
  scene.boxes = {upright(0.02, 0.62, 0, {0.3, 0.08, 0.1}, 10), upright(-0.03, 0.85, 0, {0.16, 0.12, 0.26}, -20)};
  return scene;
}

Completion given(const Scene& scene, double angle, double size, std::uint64_t seed) {
  Completion c;
  c.T_world_camera = camera_of(scene);
  c.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  Random random(seed);
  for (const OrientedBox& truth : scene.boxes) {
    Cuboid cuboid;
    cuboid.initial = truth;
    cuboid.initial.axes = Eigen::AngleAxisd(random.uniform(-angle, angle), random.direction()).toRotationMatrix() * truth.axes;
    for (int k = 0; k < 3; ++k) cuboid.initial.half_size[k] *= random.uniform(1.0 - size, 1.0 + size);
    c.cuboids.push_back(cuboid);
  }
  return c;
}

TEST(Realign, BringsBackWhatWasTurnedAndSizedWrong) {
  const Scene scene = two_boxes();
  const RgbdFrame frame = render(scene);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Completion c = given(scene, radians(15.0), 0.05, seed);
    Context context;
    realign(frame, {}, c, context);
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      const OrientedBox &box = c.cuboids[i].initial, &truth = scene.boxes[i];
      for (int k = 0; k < 3; ++k) EXPECT_LT(degrees(line_angle(box.axes.col(k), truth.axes.col(k))), 2.0) << seed << " " << i;
      EXPECT_LT((box.half_size - truth.half_size).cwiseAbs().maxCoeff(), 0.006) << seed << " " << i;
      EXPECT_LT((box.center - truth.center).norm(), 0.008) << seed << " " << i;
    }
  }
}

TEST(Realign, KeepsWhatNobodySaw) {
  const Scene scene = two_boxes();
  Completion c = given(scene, 0.0, 0.0, 1);
  c.cuboids[1].initial.half_size.y() += 0.04;  // behind
  c.cuboids[1].initial.center += 0.04 * c.cuboids[1].initial.axes.col(1);
  const OrientedBox deep = c.cuboids[1].initial;
  Context context;
  realign(render(scene), {}, c, context);
  EXPECT_LT((c.cuboids[1].initial.half_size - deep.half_size).cwiseAbs().maxCoeff(), 0.004);
  EXPECT_LT((c.cuboids[1].initial.center - deep.center).norm(), 0.005);
}

TEST(Realign, LeavesABoxWithoutPoints) {
  const Scene scene = two_boxes();
  Completion c = given(scene, 0.0, 0.0, 1);
  Cuboid elsewhere;
  elsewhere.initial = upright(1.5, 3.0, 0, {0.2, 0.2, 0.2}, 30);
  c.cuboids.push_back(elsewhere);
  Context context;
  realign(render(scene), {}, c, context);
  EXPECT_EQ(c.cuboids[2].initial.axes, elsewhere.initial.axes);
  EXPECT_EQ(c.cuboids[2].initial.center, elsewhere.initial.center);
}

}  // namespace
}  // namespace unseen::cuboids::test
