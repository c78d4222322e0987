// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>

#include "cuboids/boxes/outline.h"
#include "cuboids/boxes/upright_sides.h"
#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(Outline, TellsTheTurnOfABoxWhoseSidesAreHidden) {  // by a board before it, which cuts its top off aslant
  for (const double turn : {-8.0, 8.0}) {
    Scene scene;
    scene.boxes = {upright(0, 1.0, 0, {0.3, 0.25, 0.05}, 0), upright(-0.02, 0.72, 0, {0.5, 0.02, 0.2}, turn)};
    const Perceived p = perceive(render(scene));
    EXPECT_LT(turn_between(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 1.5) << turn;
  }
}

TEST(Outline, TellsTheTurnOfAThinBoxThatThePictureCutsOff) {
  for (const double turn : {25.0, 50.0, -30.0})
    for (const double y : {0.31, 0.36}) {
      Scene scene;
      scene.boxes = {upright(0.0, y, 0, {0.16, 0.24, 0.03}, turn), upright(0.1, 0.7, 0, {0.2, 0.15, 0.15}, 10)};
      const Perceived p = perceive(render(scene));
      ASSERT_EQ(p.fitted.size(), 2u) << turn << " " << y;
      EXPECT_LT(turn_between(nearest(p.fitted, scene.boxes[0].center).box, scene.boxes[0]), 3.0) << turn << " " << y;
    }
}

TEST(Outline, OfWhatLeansSidewaysIsNoWider) {  // a carton that is skewed; a level box around all of it is 11 mm wider
  for (const double lean : {-3.0, 3.0}) {
    Scene scene;
    scene.boxes = {upright(0.02, 0.6, 0, {0.046, 0.137, 0.213}, 0)};
    scene.boxes[0].axes = Eigen::AngleAxisd(radians(lean), Vec3::UnitY()).toRotationMatrix();
    const Perceived p = perceive(render(scene));
    const OrientedBox& box = nearest(p.fitted, scene.boxes[0].center).box;
    EXPECT_NEAR(2.0 * box.half_size.x(), 0.046, 0.005) << lean;
    EXPECT_NEAR(2.0 * box.half_size.z(), 0.213, 0.004) << lean;
    EXPECT_NEAR(box.center.x(), 0.02, 0.003) << lean;
    EXPECT_DOUBLE_EQ(box.axes(2, 2), 1.0) << lean;
  }
}

TEST(Outline, OfWhatIsWiderAboveDoesNotLean) {  // one end upright, the other 7 degrees aslant
  Scene scene;
  scene.boxes = {upright(-0.02, 0.6, 0, {0.08, 0.1, 0.2}, 0), upright(0, 0.6, 0, {0.08, 0.1, 0.2}, 0)};
  scene.boxes[1].axes = Eigen::AngleAxisd(radians(7.0), Vec3::UnitY()).toRotationMatrix();
  const Perceived p = perceive(render(scene));
  const OrientedBox& box = nearest(p.fitted, {0, 0.6, 0.1}).box;
  EXPECT_NEAR(box.center.x() - box.half_size.x(), -0.06, 0.004);
}

/// Each face that noise breaks off a front is turned a little, all together are not. A row of pixels, as of a top that is seen along itself, is no side.
TEST(Boxes, FacesOfOneSideAreOne) {
  constexpr double kSpacing = 0.005;
  Observation seen;
  Random random(3);
  const Vec3 along(std::cos(0.2), std::sin(0.2), 0), out(std::sin(0.2), -std::cos(0.2), 0);
  std::vector<Face> faces;
  const auto add = [&](const Vec3& from, int columns, int rows, double turn) {
    Face face;
    for (int u = 0; u < columns; ++u)
      for (int v = 0; v < rows; ++v) {
        face.points.push_back(static_cast<int>(seen.points.size()));
        seen.points.push_back(from + kSpacing * (u * along + v * Vec3::UnitZ()) + 0.005 * random.normal() * out);
        face.center += seen.points.back() / (columns * rows);
      }
    const Vec3 normal = Eigen::AngleAxisd(radians(turn), Vec3::UnitZ()) * out;
    face.plane = {normal, normal.dot(face.center)};
    face.length = kSpacing * std::max(columns, rows) / std::sqrt(12.0);
    face.width = kSpacing * std::sqrt((std::pow(std::min(columns, rows), 2) - 1.0) / 12.0);
    faces.push_back(face);
  };
  for (int u = 0; u < 4; ++u)
    for (int v = 0; v < 5; ++v) add(20 * kSpacing * (u * along + v * Vec3::UnitZ()), 20, 20, 4.0 + v);
  add(0.3 * out, 60, 1, -11.0);
  seen.graph.sigma.assign(seen.points.size(), 0.005f);
  seen.graph.spacing.assign(seen.points.size(), static_cast<float>(kSpacing));
  std::vector<const Face*> all;
  for (const Face& face : faces) all.push_back(&face);
  const std::vector<Face> sides = upright_sides(seen, all);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(sides[0].points.size(), 20u * 400u);
  EXPECT_LT(std::acos(std::min(1.0, sides[0].plane.normal.dot(out))), radians(0.2));
  EXPECT_EQ(sides[0].plane.normal.z(), 0.0);
}

/// Of a top that is seen along itself a few rows of pixels are seen: an edge is told no better than they let it turn.
TEST(Outline, OfATopSeenAlongItselfIsAsVagueAsItsRows) {
  int told = 0;
  for (const double height : {1.03, 1.06, 1.1, 1.15, 1.25})
    for (const double yaw : {-25.0, -10.0, -4.0, 3.0, 8.0, 20.0}) {
      Scene scene;
      scene.height = height;
      scene.pitch = radians(2.0);
      scene.noise = 0.0002;
      scene.boxes = {upright(-0.1, 2.6, 0, {0.8, 0.5, 1.0}, yaw)};
      Context context;
      const RgbdFrame frame = render(scene);
      const Observation seen = observe(frame, {}, context);
      const DepthView view(frame, seen.T_world_camera, scene.noise);
      std::vector<int> group(seen.points.size(), -1);
      for (std::size_t i = 0; i < group.size(); ++i)
        if (seen.support_of_point[i] < 0) group[i] = 0;
      const Faces faces = grow_faces(seen.points, seen.graph, group, seen.T_world_camera.translation, 24);
      std::vector<const Face*> all;
      for (const Face& face : faces.faces) all.push_back(&face);
      const Vec3 along = seen.T_world_camera.rotation * (camera_of(scene).rotation.transpose() * Vec3(scene.boxes[0].axes.col(0)));
      const double truth = std::atan2(along.y(), along.x());
      const Vec2 sum = turn_of_outline(seen, view, all, truth);
      if (sum.isZero()) continue;
      ++told;
      const double off = std::remainder(std::atan2(sum.y(), sum.x()) - 4.0 * truth, 2.0 * kPi) / 4.0;
      EXPECT_LT(std::abs(off) * std::sqrt(sum.norm()), 3.0) << height << " m, " << yaw << " degrees: off by " << degrees(off);
    }
  EXPECT_GT(told, 10);
}

/// Few points of its narrow side are seen, and their plane is some degrees off.
TEST(Boxes, ABoardThatLeansHasLevelEdges) {
  for (const double lean : {20.0, 35.0})
    for (const int seed : {1, 2, 3, 4}) {
      Scene scene;
      OrientedBox board = upright(0, 0.9, 0, {0.36, 0.012, 0.3}, -25);
      board.axes = board.axes * Eigen::AngleAxisd(-radians(lean), Vec3::UnitX()).toRotationMatrix();
      board.center.z() = board.axes.row(2).cwiseAbs() * board.half_size;
      scene.boxes = {board};
      const Perceived p = perceive(render(scene, seed));
      ASSERT_EQ(p.fitted.size(), 1u);
      EXPECT_LT(degrees(std::asin(p.fitted[0].box.axes.row(2).cwiseAbs().minCoeff())), 0.6) << lean << " " << seed;
    }
}

}  // namespace
}  // namespace unseen::cuboids::test
