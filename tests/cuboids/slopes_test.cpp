// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Grounds and desks that slope.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

/// Three faces of each are seen, and none is most of it: alone they would tell of no lean.
TEST(Slopes, BoxesOnThemLieAsTheyDo) {
  for (const double slope : {-7.0, 7.0, 9.0}) {
    Scene scene;
    scene.boxes = {upright(-0.2, 0.8, 0, {0.14, 0.12, 0.12}, 40), upright(0.15, 0.75, 0, {0.12, 0.16, 0.14}, -35), upright(0.15, 0.75, 0.14, {0.08, 0.1, 0.09}, -35)};
    RgbdFrame frame = render(scene);
    const Mat3 rotation = camera_of(scene).rotation;
    frame.up = rotation.transpose() * (Eigen::AngleAxisd(radians(slope), Vec3(0.6, 0.8, 0)) * Vec3::UnitZ());
    const Perceived p = perceive(frame);
    ASSERT_EQ(p.fitted.size(), 3u) << slope;
    const Mat3 turn = p.seen.T_world_camera.rotation * rotation.transpose();  // from the slope to what is level
    EXPECT_NEAR(degrees(line_angle(turn.col(2), Vec3::UnitZ())), std::abs(slope), 0.5);
    for (const Cuboid& cuboid : p.fitted) {
      EXPECT_LT(degrees(line_angle(cuboid.box.axes.col(2), turn.col(2))), 0.7) << slope;
      const OrientedBox& truth = *std::min_element(scene.boxes.begin(), scene.boxes.end(), [&](const OrientedBox& a, const OrientedBox& b) {
        return (turn * a.center - cuboid.box.center).head<2>().norm() < (turn * b.center - cuboid.box.center).head<2>().norm();
      });
      const double off = (cuboid.box.axes.transpose() * turn * truth.axes.col(0)).cwiseAbs().maxCoeff();
      EXPECT_LT(degrees(std::acos(std::min(off, 1.0))), 1.5) << slope;
    }
  }
}

TEST(Slopes, OfADeskAboveThemLeaveBoxesLevel) {  // a drawing table whose plane rises over them
  Scene scene;
  scene.height = 1.1;
  scene.pitch = radians(25.0);
  scene.boxes = {upright(-0.1, 1.4, 0, {0.2, 0.2, 0.4}, 1), upright(0.25, 1.5, 0, {0.22, 0.2, 0.25}, 40), upright(0.6, 1.4, 0, {0.2, 0.25, 0.3}, -30)};
  RgbdFrame frame = render(scene);
  const RigidTransform T = camera_of(scene);
  const auto seen = [&](const Vec3& normal, const Vec3& on) { return Plane{T.rotation.transpose() * normal, normal.dot(on - T.translation)}; };
  frame.up = T.rotation.row(2).transpose();
  frame.supports = {{seen(Vec3::UnitZ(), Vec3::Zero()), "ground"}, {seen(Vec3(-std::sin(radians(9.0)), 0, std::cos(radians(9.0))), Vec3(-0.6, 1.4, 0.5)), "desk"}};
  const Perceived p = perceive(frame);
  ASSERT_EQ(p.fitted.size(), 3u);
  for (const OrientedBox& box : scene.boxes) {
    EXPECT_EQ(nearest(p.fitted, box.center).box.axes(2, 2), 1.0) << box.center.x();
    EXPECT_LT(size_error(nearest(p.fitted, box.center).box, box), 0.02) << box.center.x();
  }
}

TEST(Slopes, OfAGivenDeskCarryWhatIsOnIt) {
  Scene scene;
  scene.boxes = {upright(-0.2, 0.8, 0, {0.14, 0.12, 0.12}, 40), upright(0.15, 0.75, 0, {0.12, 0.16, 0.14}, -35)};
  RgbdFrame frame = render(scene);
  const RigidTransform T = camera_of(scene);
  const Vec3 up = Eigen::AngleAxisd(radians(8.0), Vec3(0.6, 0.8, 0)) * Vec3::UnitZ();
  const auto seen = [&](const Vec3& normal, const Vec3& on) { return Plane{T.rotation.transpose() * normal, normal.dot(on - T.translation)}; };
  frame.up = T.rotation.transpose() * up;
  frame.supports = {{seen(up, Vec3(0, 0.8, -0.7)), "ground"}, {seen(Vec3::UnitZ(), Vec3::Zero()), "desk"}};
  const Perceived p = perceive(frame);
  ASSERT_EQ(p.fitted.size(), 2u);
  const Vec3 normal = p.seen.T_world_camera.rotation * T.rotation.row(2).transpose();
  EXPECT_NEAR(degrees(line_angle(normal, Vec3::UnitZ())), 8.0, 0.5);
  for (const Cuboid& cuboid : p.fitted) EXPECT_LT(degrees(line_angle(cuboid.box.axes.col(2), normal)), 0.7);
}

}  // namespace
}  // namespace unseen::cuboids::test
