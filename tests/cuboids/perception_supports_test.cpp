// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "cuboids/search/hypotheses.h"
#include "cuboids/statics/interface.h"
#include "cuboids/surfaces/levels.h"
#include "perception_scenes.h"
#include "unseen/core/error.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

Scene few_boxes() {
  Scene scene;
  scene.boxes = {upright(-0.2, 0.8, 0, {0.26, 0.2, 0.12}, 5), upright(-0.19, 0.81, 0.12, {0.15, 0.12, 0.07}, 40),
                 upright(0.2, 0.7, 0, {0.1, 0.12, 0.2}, -20)};
  return scene;
}

/// As few_boxes(), one of them against a wall that is as large as the ground.
Scene by_a_wall() {
  Scene scene = few_boxes();
  scene.height = 0.9;
  scene.boxes.push_back(upright(0.15, 1.35, 0, {0.3, 0.3, 0.25}, 0));
  scene.boxes.push_back(upright(0.0, 1.55, 0, {6.0, 0.1, 3.0}, 0));
  return scene;
}

struct ToldUp {
  double error = 0;  ///< degrees
  std::vector<std::string> warnings;
};

ToldUp up_of(const Scene& scene) {
  Context context;
  const Observation seen = observe(render(scene), {}, context);
  const Vec3 up = seen.T_world_camera.rotation.row(2).transpose(), truth = camera_of(scene).rotation.row(2).transpose();
  return {degrees(std::acos(std::clamp(up.dot(truth), -1.0, 1.0))), context.take_warnings()};
}

TEST(Up, IsFoundHoweverTheCameraWasTurned) {
  for (Scene scene : {few_boxes(), by_a_wall()})
    for (const double roll : {30.0, -60.0, 75.0, 90.0, -90.0, 180.0}) {
      scene.roll = radians(roll);
      EXPECT_LT(up_of(scene).error, 1.0) << roll;
    }
}

TEST(Up, IsFoundUpsideDownWhereMasksLeaveNothingButTheFloor) {
  Scene scene = few_boxes();
  for (const double roll : {130.0, 180.0}) {
    scene.roll = radians(roll);
    RgbdFrame frame = render(scene);
    for (const auto& color : frame.color) frame.masks.push_back(color[0] == 60 ? 0 : 1);  // the ground's shade
    Context context;
    const Observation seen = observe(frame, {}, context);
    EXPECT_LT(degrees(line_angle(seen.T_world_camera.rotation.row(2).transpose(), camera_of(scene).rotation.row(2).transpose())), 1.0) << roll;
    EXPECT_GT(seen.T_world_camera.translation.z(), 0.5) << roll;
  }
}

TEST(Up, OfAnUnusualPictureIsRemarkedOn) {
  Scene scene = few_boxes();
  EXPECT_TRUE(up_of(scene).warnings.empty());
  scene.roll = radians(45.0);
  EXPECT_TRUE(up_of(scene).warnings.empty());
  scene.roll = radians(90.0);
  const std::vector<std::string> warnings = up_of(scene).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("up is taken as [-0.82, 0.00, -0.57] from the ground"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("\"up\" in frame.json"), std::string::npos) << warnings[0];
}

TEST(Up, ThatTheFrameStatesIsTakenWithoutRemark) {
  Scene scene = few_boxes();
  scene.roll = radians(180.0);
  RgbdFrame frame = render(scene);
  const Vec3 up = camera_of(scene).rotation.row(2).transpose();
  frame.up = up;
  Context context;
  const Observation seen = observe(frame, {}, context);
  EXPECT_LT(degrees(line_angle(seen.T_world_camera.rotation.row(2).transpose(), up)), 1.0);
  EXPECT_TRUE(context.take_warnings().empty());
}

TEST(Up, OfALargeBareWallBesideASmallFloorIsThatOfTheFloor) {
  Scene scene = few_boxes();
  scene.pitch = radians(15.0);
  scene.height = 0.7;
  OrientedBox wall = upright(0, 0, 0, {0.1, 8.0, 3.0}, -40.0);  // to the left and behind, seen at a slant
  wall.center += Vec3(-0.6, 2.0, 0);
  scene.boxes.push_back(wall);
  const ToldUp told = up_of(scene);
  EXPECT_LT(told.error, 1.0);
  EXPECT_TRUE(told.warnings.empty());
}

TEST(Up, StraightAboveIsThatOfTheFloorNotOfASideOfABox) {  // to which the floor is upright
  Scene scene;
  scene.height = 2.2;
  scene.pitch = radians(89.0);
  scene.boxes = {upright(-0.4, 0.2, 0, {0.4, 0.3, 0.2}, 20), upright(0.3, 0.3, 0, {0.3, 0.3, 0.4}, -10), upright(0.1, -0.3, 0, {0.5, 0.25, 0.15}, 0),
                 upright(0.15, -0.3, 0.15, {0.2, 0.15, 0.1}, 30)};
  EXPECT_LT(up_of(scene).error, 1.0);
}

/// Points on a grid of a plane z = slope · y, as a face.
struct Flat {
  std::vector<Vec3> points;
  PointGraph graph;
  Faces faces;
  std::vector<Level> levels;

  void add(double from, double depth, double height, double slope) {
    Face& face = faces.faces.emplace_back();
    for (int i = 0; i < 40; ++i)
      for (int k = 0; k < 20; ++k) {
        const double y = from + depth * k / 19.0;
        face.points.push_back(static_cast<int>(points.size()));
        points.emplace_back(i / 39.0, y, height + slope * (y - from - 0.5 * depth));
        graph.sigma.push_back(0.005);
      }
    Level& level = levels.emplace_back();
    level.faces = {static_cast<int>(faces.faces.size()) - 1};
    level.plane = Plane{Vec3(0, -slope, 1).normalized(), 0};
    level.plane.offset = level.plane.normal.dot(Vec3(0, from + 0.5 * depth, height));
  }
  Scan scan() const { return {points, graph, faces, true}; }
};

TEST(Up, IsThatOfATableWhereButAStripOfFloorIsSeen) {
  Flat flat;
  flat.add(0.5, 1.0, 0.75, 0.0);
  flat.add(3.0, 0.08, 0.0, 0.1);  // 6° wrong
  EXPECT_LT(tilt_error(flat.scan(), flat.faces.faces[0].points), 0.006);
  EXPECT_GT(tilt_error(flat.scan(), flat.faces.faces[1].points), 0.03);
  level_with_surest(flat.scan(), flat.levels, flat.levels[1]);
  EXPECT_LT(line_angle(flat.levels[1].plane.normal, Vec3::UnitZ()), 1e-9);
  EXPECT_NEAR(flat.levels[1].plane.offset, 0.0, 1e-3);
}

TEST(Up, IsThatOfTheFloorWhereMuchOfItIsSeen) {
  Flat flat;
  flat.add(0.5, 1.0, 0.75, 0.0);
  flat.add(2.0, 0.8, 0.0, 0.01);
  const Plane as_seen = flat.levels[1].plane;
  level_with_surest(flat.scan(), flat.levels, flat.levels[1]);
  EXPECT_EQ(flat.levels[1].plane.normal, as_seen.normal);
}

/// What is seen to be free under the near edge of a table top is no room for it to grow into.
TEST(Rooms, UnderTheEdgeOfATableAreNone) {
  Scene scene;
  scene.height = 1.3;
  scene.pitch = radians(17.0);
  scene.noise = 0.001;
  scene.boxes = {upright(0, 1.0, 0.7, {2.4, 0.6, 0.03}, 0)};  // half of it in the picture, and little below it
  const RgbdFrame frame = render(scene);
  const DepthView view(frame, camera_of(scene), scene.noise);
  Cuboid top;
  top.initial = scene.boxes[0];
  const OrientedBox& box = top.initial;
  const int below = face_normal(box, 4).z() < 0.0 ? 4 : 5;
  EXPECT_LT(find_rooms(view, {top}, {0.01})[0][below], 0.2);
  scene.boxes[0] = upright(0, 1.0, 0, {2.4, 0.6, 0.73}, 0);  // a chest, of which the front is seen
  const DepthView closed(render(scene), camera_of(scene), scene.noise);
  EXPECT_GT(find_rooms(closed, {top}, {0.01})[0][below], 0.6);
}

TEST(Up, ThatNoPlaneIsOrthogonalToGivesWayToThatOfARamp) {
  const Scene scene = few_boxes();
  RgbdFrame frame = render(scene);
  const Vec3 normal = camera_of(scene).rotation.row(2).transpose();
  const auto leaning = [&](double angle) -> Vec3 { return Eigen::AngleAxisd(radians(angle), Vec3::UnitX()) * normal; };
  frame.up = leaning(14.0);
  Context context;
  const Observation seen = observe(frame, {}, context);
  EXPECT_LT(degrees(line_angle(seen.T_world_camera.rotation.row(2).transpose(), normal)), 1.0);
  const std::vector<std::string> warnings = context.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("leans by 14°"), std::string::npos) << warnings[0];
  frame.up = leaning(40.0);
  EXPECT_THROW(observe(frame, {}, context), InputError);
}

/// What the frame file says may not be what was meant.
TEST(Given, SupportsWithNothingOnThemAndOblongPixelsAreSaid) {
  const RgbdFrame frame = render(few_boxes());
  const auto warnings = [&](const Plane& ground, double oblong) {
    RgbdFrame given = frame;
    given.supports = {{ground, "ground"}};
    given.camera.fy *= oblong;
    Context context;
    observe(given, {}, context);
    return context.take_warnings();
  };
  const RigidTransform T = camera_of(few_boxes());
  const Vec3 normal = T.rotation.row(2).transpose();
  const double height = few_boxes().height;
  EXPECT_TRUE(warnings({normal, -height}, 1.1).empty());
  const std::vector<std::string> far = warnings({normal, -height - 5.0}, 1.0), oblong = warnings({normal, -height}, 0.1);
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0].find("lies on the ground that is given"), std::string::npos) << far[0];
  ASSERT_FALSE(oblong.empty());
  EXPECT_NE(oblong[0].find("fx = 525 and fy = 52.5"), std::string::npos) << oblong[0];
}

/// A box on a floor in front of a wall, which is `distance` m away and wider than the picture.
Scene before_a_wall(double distance) {
  Scene scene;
  scene.height = 1.2;
  scene.pitch = radians(20.0);
  scene.boxes = {upright(0.3, 2.0, 0, {0.4, 0.3, 0.4}, 20), upright(0.0, distance + 0.05, 0, {16.0, 0.1, 4.0}, 0)};
  return scene;
}

TEST(Walls, FarAwayAreOnesToo) {
  for (const double distance : {3.0, 4.0, 5.0, 6.0})
    for (const std::uint64_t seed : {1, 2}) {
      const Perceived p = perceive(render(before_a_wall(distance), seed));
      ASSERT_EQ(p.seen.supports.size(), 2u) << distance;
      EXPECT_EQ(p.seen.supports[1].kind, SupportKind::wall);
      EXPECT_NEAR(p.seen.supports[1].plane.signed_distance(Vec3(0, distance, 1.0)), 0.0, 0.03) << distance;
      EXPECT_LT(p.seen.supports[1].plane.normal.y(), -0.999) << distance;
      EXPECT_EQ(p.cuboids.size(), 1u) << distance;
    }
}

TEST(Walls, AreNotLargeBoxesWhoseTopsAreNotInThePicture) {
  Scene scene = before_a_wall(3.4);
  scene.boxes.front() = upright(0.1, 2.2, 0, {1.6, 0.8, 1.8}, 8);
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.seen.supports.size(), 2u);
  EXPECT_NEAR(p.seen.supports[1].plane.signed_distance(Vec3(0, 3.4, 1.0)), 0.0, 0.03);
  ASSERT_EQ(p.cuboids.size(), 1u);
  EXPECT_NEAR(2.0 * p.cuboids[0].box.half_size.head<2>().maxCoeff(), 1.6, 0.03);
}

TEST(Walls, AreNotPiercedByWhatStandsAgainstThem) {
  for (const Vec3& size : {Vec3(1.0, 0.2, 0.8), Vec3(0.6, 0.12, 0.5), Vec3(0.8, 0.3, 0.9)}) {
    Scene scene = before_a_wall(2.2);
    scene.height = 1.4;
    scene.boxes[0] = upright(0.1, 2.2 - 0.5 * size.y(), 0, size, 0);
    Context context;
    const Completion completion = complete_cuboids(render(scene), Options{}, context);
    ASSERT_EQ(completion.cuboids.size(), 1u);
    ASSERT_EQ(completion.supports.size(), 2u);
    for (const Vec3& corner : solid_of(completion.cuboids[0].box).vertices)
      EXPECT_GT(completion.supports[1].plane.signed_distance(corner), -0.015) << size.transpose();
    EXPECT_EQ(completion.fixed_contacts, 0);
  }
}

/// A camera that looks down at 45°: of what stands more than two metres away it sees the foot alone.
Scene before_the_foot_of(const OrientedBox& far) {
  Scene scene;
  scene.height = 1.0;
  scene.pitch = radians(45.0);
  scene.boxes = {upright(0.1, 1.2, 0, {0.3, 0.2, 0.2}, 15), far};
  return scene;
}

TEST(Walls, AreOnesOfWhichThePictureShowsAStrip) {
  for (const double distance : {2.3, 2.4})
    for (const double yaw : {0.0, 20.0, -35.0}) {
      const OrientedBox wall = upright(0.0, distance, 0, {16.0, 0.1, 4.0}, yaw);
      const Perceived p = perceive(render(before_the_foot_of(wall)));
      ASSERT_EQ(p.seen.supports.size(), 2u) << distance << " " << yaw;
      EXPECT_GT(std::abs(p.seen.supports[1].plane.normal.dot(wall.axes.col(1))), std::cos(radians(2.0))) << distance << " " << yaw;
      EXPECT_EQ(p.cuboids.size(), 1u) << distance << " " << yaw;
    }
}

TEST(Walls, AreNotCartonsOfWhichThePictureShowsTheFoot) {
  for (const double x : {-1.1, -0.4, 0.6})
    for (const double yaw : {0.0, 10.0, 35.0})
      for (const double width : {0.4, 0.8}) {
        Scene scene = before_the_foot_of(upright(x, 2.2, 0, {width, 0.5, 1.0}, yaw));
        scene.boxes.push_back(upright(0.0, 4.0, 0, {16.0, 0.1, 4.0}, 0));  // not in the picture
        const Perceived p = perceive(render(scene));
        EXPECT_EQ(p.seen.supports.size(), 1u) << x << " " << yaw << " " << width;
        EXPECT_EQ(p.cuboids.size(), 2u) << x << " " << yaw << " " << width;
      }
}

TEST(Walls, AreNotTallCartonsBesideWhichTheFloorGoesOn) {
  for (const double x : {-0.2, 0.1, 0.3})
    for (const double yaw : {0.0, 10.0, 30.0})
      for (const double width : {0.5, 0.8}) {
        Scene scene;
        scene.height = 1.1;
        scene.pitch = radians(50.0);
        scene.boxes = {upright(x, 1.3, 0, {width, 0.5, 1.3}, yaw), upright(-0.5, 0.6, 0, {0.2, 0.2, 0.2}, 15)};
        const Perceived p = perceive(render(scene));
        EXPECT_EQ(p.seen.supports.size(), 1u) << x << " " << yaw << " " << width;
        EXPECT_EQ(p.cuboids.size(), 2u) << x << " " << yaw << " " << width;
      }
}

/// A side table far away, of less than a tenth of the floor's pixels: what masks name stands on it, and on the floor beside it.
TEST(Desks, ThatAreSmallInThePictureCarryWhatMasksName) {
  Scene scene;
  scene.height = 1.5;
  scene.boxes = {upright(-0.1, 2.3, 0.5, {0.15, 0.12, 0.1}, 10), upright(0.12, 2.35, 0.5, {0.1, 0.12, 0.15}, -15), upright(0.7, 2.0, 0.0, {0.15, 0.15, 0.15}, 5),
                 upright(0.0, 2.35, 0.0, {0.6, 0.4, 0.5}, 0)};
  RgbdFrame frame = render(scene);
  for (const auto& color : frame.color) frame.masks.push_back(color[2] == 120 ? 1 : color[2] == 240 ? 2 : color[2] == 104 ? 3 : 0);  // by their shade
  Context context;
  const Completion completion = complete_cuboids(frame, {}, context);
  EXPECT_EQ(completion.cuboids.size(), 3u);
  EXPECT_TRUE(completion.unsupported.empty());
  EXPECT_TRUE(std::any_of(completion.supports.begin(), completion.supports.end(), [](const Support& s) { return s.kind == SupportKind::desk; }));
}

/// A frame with masks 1, 2, … on the first so many boxes of a scene, by their shade.
RgbdFrame masked(const Scene& scene, int count) {
  RgbdFrame frame = render(scene);
  for (const auto& color : frame.color) {
    int mask = 0;
    for (int b = 1; b <= count; ++b)
      if (color[2] == b * 120 % 256) mask = b;
    frame.masks.push_back(mask);
  }
  return frame;
}

TEST(Desks, AreNoneBetweenRailsThroughWhichABeltIsSeen) {
  Scene scene;
  scene.height = 1.98, scene.pitch = radians(63.0);
  scene.width = 1280, scene.image_height = 720, scene.focal = 915;
  scene.boxes = {upright(-0.6, 0.6, 0.76, {0.26, 0.22, 0.1}, 20), upright(-0.03, 0.57, 0.76, {0.33, 0.22, 0.2}, -10), upright(0.59, 0.51, 0.76, {0.3, 0.19, 0.1}, 5),
                 upright(0.34, 0.68, 0.76, {0.18, 0.13, 0.1}, 30), upright(0, 0.6, 0, {2.4, 0.6, 0.76}, 0), upright(0, 0.28, 0, {2.4, 0.03, 0.84}, 0), upright(0, 0.92, 0, {2.4, 0.03, 0.84}, 0)};
  Context context;
  const Completion completion = complete_cuboids(masked(scene, 4), {}, context);
  ASSERT_EQ(completion.cuboids.size(), 4u);
  for (const Cuboid& cuboid : completion.cuboids) EXPECT_LT(size_error(cuboid.box, scene.boxes[std::stoi(cuboid.label) - 1]), 0.02) << cuboid.label;
}

TEST(Desks, AreLevelWithTheGroundAndMakeNoDebrisOfBoxesAsHighAsThey) {
  Scene scene;  // two steps with a box each: the one before the second step is as high as that
  scene.height = 1.3;
  scene.noise = 0.003;
  scene.boxes = {upright(-0.3, 1.45, 0.17, {0.25, 0.14, 0.17}, 0), upright(0.25, 1.75, 0.34, {0.2, 0.14, 0.1}, 0), upright(0, 2.3, 0, {1.6, 2.0, 0.17}, 0), upright(0, 2.6, 0.17, {1.6, 2.0, 0.17}, 0)};
  Context context;
  const Completion completion = complete_cuboids(masked(scene, 2), {}, context);
  EXPECT_EQ(completion.cuboids.size(), 2u);
  EXPECT_GE(completion.supports.size(), 3u);
  for (const Support& s : completion.supports)
    if (s.kind == SupportKind::desk) {
      EXPECT_LT(degrees(line_angle(s.plane.normal, completion.supports[0].plane.normal)), 0.01);
    }
}

TEST(Desks, MakeNoDebrisOfBoxesBesideThemWhoseTopsAreAsHigh) {
  Scene scene;  // seen from above: of the box on the floor hardly more than its top
  scene.height = 1.5, scene.pitch = radians(85.0);
  scene.boxes = {upright(-0.3, 0.15, 0.17, {0.15, 0.15, 0.12}, 10), upright(0.35, 0.15, 0, {0.2, 0.2, 0.17}, 5), upright(-0.35, 0.15, 0, {0.6, 0.6, 0.17}, 0)};
  Context context;
  EXPECT_EQ(complete_cuboids(masked(scene, 2), {}, context).cuboids.size(), 2u);
}

TEST(Supports, OutlinesStayWhereTheyWereSeenWhereUpWasGuessed) {
  Level level;
  level.plane = {Vec3(0.06, -0.08, 1).normalized(), -2.0};
  level.outline = {{0, 0}, {1, 0}, {1, 1}};
  const Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  const std::vector<Vec3> outline = lifted(level, u, v);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((outline[i].head<2>() - level.outline[i]).norm(), 1e-12);
    EXPECT_NEAR(level.plane.signed_distance(outline[i]), 0.0, 1e-12);
  }
}

TEST(Walls, LeaveAThinPanelThatAMaskNames) {
  Scene scene = before_a_wall(2.5);
  scene.boxes[0] = upright(0.1, 2.5 - 0.015, 0, {1.0, 0.03, 0.8}, 0);
  RgbdFrame frame = render(scene);
  for (const auto& color : frame.color) frame.masks.push_back(color[2] == 120 ? 1 : 0);  // the first box
  const Perceived p = perceive(frame);
  ASSERT_EQ(p.seen.supports.size(), 2u);
  ASSERT_EQ(p.fitted.size(), 1u);
  EXPECT_NEAR(2.0 * p.fitted[0].box.half_size.z(), 0.8, 0.04);
}

TEST(Walls, OfACornerAreBothFound) {
  Scene scene = before_a_wall(4.0);
  scene.boxes.push_back(upright(1.75, 2.0, 0, {0.1, 8.0, 4.0}, 0));
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.seen.supports.size(), 3u);
  EXPECT_EQ(p.seen.supports[1].kind, SupportKind::wall);
  EXPECT_EQ(p.seen.supports[2].kind, SupportKind::wall);
  EXPECT_EQ(p.cuboids.size(), 1u);
}

}  // namespace
}  // namespace unseen::cuboids::test
