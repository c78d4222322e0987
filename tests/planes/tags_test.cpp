// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <cmath>

#include "planes/result/describe.h"
#include "planes/result/remarks.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// Adds a rectangle from `low` to `high` along two edges.
void add(Arrangement& all, const Vec3& corner, const Vec3& a, const Vec3& b) {
  ArrangedPlane p;
  p.plane.normal = a.cross(b).normalized();
  p.plane.offset = p.plane.normal.dot(corner);
  p.polygon = {{corner, corner + a, corner + a + b, corner + b}};
  p.area = a.norm() * b.norm();
  p.direction = static_cast<int>(all.directions.size());
  all.directions.push_back({p.plane.normal, 0});
  all.planes.push_back(p);
}

/// 8 × 6 m, 2.7 m high, with a table; the next storey lies 0.3 m above.
void add_storey(Arrangement& all, double floor, double fall = 0.0) {
  const Vec3 x(8, 0, 8 * std::tan(fall)), y(0, 6, 0), z(0, 0, 2.7);
  add(all, {0, 0, floor}, x, y);
  add(all, {0, 0, floor + 2.7}, Vec3(8, 0, 0), y);
  add(all, {0, 0, floor}, Vec3(8, 0, 0), z);
  add(all, {0, 0, floor}, y, z);
  add(all, {3, 2, floor + 0.75}, Vec3(1.6, 0, 0), Vec3(0, 0.8, 0));
  add(all, {3, 2, floor + 0.3}, Vec3(1.6, 0, 0), Vec3(0, 0, 0.4));
}

std::vector<std::string> tags(Arrangement all) {
  tag_planes(all);
  std::vector<std::string> result;
  for (const ArrangedPlane& p : all.planes) result.push_back(p.tag);
  return result;
}

const std::vector<std::string> kStorey = {"floor", "ceiling", "wall", "wall", "horizontal", "vertical"};

TEST(Tags, OfARoomAndOfEachStorey) {
  for (const int storeys : {1, 2, 4}) {
    Arrangement all;
    std::vector<std::string> expected;
    for (int s = 0; s < storeys; ++s) {
      add_storey(all, 3.0 * s);
      expected.insert(expected.end(), kStorey.begin(), kStorey.end());
    }
    EXPECT_EQ(tags(all), expected) << storeys;
  }
}

TEST(Tags, AFloorMayFallALittleAndASlopeDoesNot) {
  Arrangement all;
  add_storey(all, 0.0, 0.5 * kPi / 180.0);
  EXPECT_EQ(tags(all), kStorey);
  Arrangement ramp;
  add_storey(ramp, 0.0);
  add(ramp, {0, 7, 0}, Vec3(8, 0, 8 * std::tan(5 * kPi / 180.0)), Vec3(0, 2, 0));
  EXPECT_EQ(tags(ramp).back(), "sloped");
}

/// A house, 10 × 8 m, on ground that falls by 3°, with a roof of one slope of 6°.
TEST(Tags, WallsSayWhatIsPlumbNotTheGroundNorTheRoof) {
  const double fall = std::tan(3 * kPi / 180.0), pitch = std::tan(6 * kPi / 180.0);
  Arrangement all;
  add(all, {-20, -20, -20 * fall}, Vec3(50, 0, 0), Vec3(0, 50, 50 * fall));
  add(all, {0, 0, 3}, Vec3(10, 0, 0), Vec3(0, 8, 8 * pitch));
  for (const double y : {0.0, 8.0}) add(all, {0, y, y * fall}, Vec3(10, 0, 0), Vec3(0, 0, 3));
  for (const double x : {0.0, 10.0}) add(all, {x, 0, 0}, Vec3(0, 8, 0), Vec3(0, 0, 3));
  add(all, {0, 0, 0}, Vec3(0.05, 0.05, 0), Vec3(0, 0, 3));
  EXPECT_EQ(tags(all), (std::vector<std::string>{"sloped", "sloped", "wall", "wall", "wall", "wall", "vertical"}));
  // all of it tilted by 5°, as by a scanner that was not levelled
  Arrangement room;
  add_storey(room, 0.0);
  const Mat3 tilt = Eigen::AngleAxisd(5 * kPi / 180.0, Vec3(1, 2, 0).normalized()).toRotationMatrix();
  for (ArrangedPlane& p : room.planes) {
    p.plane.normal = tilt * p.plane.normal;
    room.directions[p.direction].normal = p.plane.normal;
    for (Vec3& corner : p.polygon.front()) corner = tilt * corner;
  }
  EXPECT_EQ(tags(room), kStorey);
}

TEST(Tags, OfARoadWithACrownAndOfALonePlane) {
  const double fall = std::tan(1.2 * kPi / 180.0);
  Arrangement road;
  add(road, {0, 0, 0}, Vec3(40, 0, 0), Vec3(0, 3, 3 * fall));
  add(road, {0, 6, 0}, Vec3(40, 0, 0), Vec3(0, -3, 3 * fall));
  EXPECT_EQ(tags(road), (std::vector<std::string>{"floor", "floor"}));
  Arrangement ground;
  add(ground, {0, 0, 0}, Vec3(40, 0, 0.1), Vec3(0, 30, 0));
  EXPECT_EQ(tags(ground), std::vector<std::string>{"floor"});
}

/// A facade, a street before it and a crate that lies askew, turned about the vertical.
Arrangement facade(double yaw, double crate) {
  const Eigen::AngleAxisd turn(yaw, Vec3::UnitZ());
  const Eigen::AngleAxisd askew(crate, Vec3(1, 2, 0).normalized());
  Arrangement all;
  add(all, turn * Vec3(0, 0, 0), turn * Vec3(14, 0, 0), turn * Vec3(0, 0, 9));
  add(all, turn * Vec3(-3, -14, 0), turn * Vec3(20, 0, 0), turn * Vec3(0, 14, 0));
  const Vec3 x = turn * (askew * Vec3(0.8, 0, 0)), y = turn * (askew * Vec3(0, 0.8, 0)), z = turn * (askew * Vec3(0, 0, 0.8)), at = turn * Vec3(5, -5, 0);
  for (const auto& [a, b] : {std::pair(x, y), {x, z}, {y, z}}) add(all, at, a, b);
  return all;
}

TEST(Tags, OfAFacadeAlone) {
  for (int i = 0; i < 60; ++i)
    for (const double crate : {0.0, 9.0}) {
      const std::vector<std::string> found = tags(facade(radians(1.5 * i), radians(crate)));
      EXPECT_EQ(found[0], "wall") << i << " " << crate;
      EXPECT_EQ(found[1], "floor") << i << " " << crate;
    }
}

TEST(Tags, AGhostBelowTheFloorTakesNothingFromIt) {
  Arrangement all;
  add_storey(all, 0.0);
  add(all, {3, 3, -1.4}, Vec3(0.5, 0, 0), Vec3(0, 0.3, 0));
  add(all, {4, 3, 4.1}, Vec3(0.5, 0, 0), Vec3(0, 0.3, 0));
  std::vector<std::string> expected = kStorey;
  expected.insert(expected.end(), {"horizontal", "horizontal"});
  EXPECT_EQ(tags(all), expected);
}

TEST(Tags, HousesFromAboveEndTheScene) {
  Arrangement all;
  add(all, {0, 0, 0}, Vec3(300, 0, 0), Vec3(0, 300, 0));
  for (int i = 0; i < 20; ++i) {
    add(all, {14.0 * i, 40, 7}, Vec3(10, 0, 0), Vec3(0, 8, 0));
    add(all, {14.0 * i, 40, 0}, Vec3(10, 0, 0), Vec3(0, 0, 7));
  }
  add(all, {0, 20, 0}, Vec3(30, 0, 0), Vec3(0, 0, 1));  // of a garden
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(found[0], "floor");
  EXPECT_EQ(found[2], "wall");
  EXPECT_EQ(found.back(), "vertical");
}

TEST(Tags, StepsAreNeitherFloorsNorCeilings) {
  Arrangement all;
  for (int i = 0; i < 12; ++i) add(all, {0.28 * i, 0, 0.17 * i}, Vec3(0.3, 0, 0), Vec3(0, 1, 0));
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(std::count(found.begin() + 2, found.end() - 2, "horizontal"), 8);
}

/// Of a room that is turned.
std::size_t warnings_of_up(const Eigen::Matrix3d& turn) {
  Arrangement all;
  for (const auto& [corner, a, b] : {std::tuple(Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(0, 6, 0)), {Vec3(0, 0, 2.7), Vec3(8, 0, 0), Vec3(0, 6, 0)},
                                     {Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(0, 0, 2.7)}, {Vec3(0, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 2.7)}})
    add(all, turn * corner, turn * a, turn * b);
  tag_planes(all);
  Context context;
  warn_of_up(all, context);
  return context.take_warnings().size();
}

/// The ground's outline goes around the pit, whose floor lies below nothing.
TEST(Tags, GroundAroundAPitIsNoCeiling) {
  Arrangement all;
  add(all, {0, 0, -4}, Vec3(10, 0, 0), Vec3(0, 10, 0));
  add(all, {-5, -5, 0}, Vec3(20, 0, 0), Vec3(0, 20, 0));
  all.planes[1].polygon.push_back({{-2, -2, 0}, {12, -2, 0}, {12, 12, 0}, {-2, 12, 0}});
  for (const double y : {0.0, 10.0}) add(all, {0, y, -4}, Vec3(10, 0, 0), Vec3(0, 0, 4));
  const std::vector<std::string> open = tags(all);
  EXPECT_EQ(open[0], "floor");
  EXPECT_EQ(open[1], "horizontal");
  all.planes[1].polygon.pop_back();  // a room below a slab
  const std::vector<std::string> covered = tags(all);
  EXPECT_EQ(covered[0], "floor");
  EXPECT_EQ(covered[1], "ceiling");
}

/// A ceiling in two bays, whose floor was cut off.
TEST(Tags, CeilingsNeedNoFloor) {
  Arrangement all;
  for (const double x : {0.0, 5.0}) add(all, {x, 0, 2.7}, Vec3(4, 0, 0), Vec3(0, 6, 0));
  for (const double y : {0.0, 6.0}) add(all, {0, y, 0.5}, Vec3(9, 0, 0), Vec3(0, 0, 2.2));
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(found[0], "ceiling");
  EXPECT_EQ(found[1], "ceiling");
}

/// A room of 5 × 4 m with a floor, a ceiling and four walls; 12 cm stand between it and the next one.
void add_room(Arrangement& all, double at, double floor, double height) {
  const Vec3 x(5, 0, 0), y(0, 4, 0), z(0, 0, height), corner(at, 0, floor);
  add(all, corner, x, y);
  add(all, corner + z, x, y);
  add(all, corner, x, z);
  add(all, corner + y, x, z);
  add(all, corner, y, z);
  add(all, corner + x, y, z);
}

TEST(Tags, OfRoomsAtSeveralHeights) {
  for (const auto& [floor, height] : {std::pair(0.0, 2.2), {0.6, 2.7}, {1.3, 2.7}, {-1.0, 2.5}}) {
    Arrangement all;
    add_room(all, 0, 0, 2.7);
    add_room(all, 5.12, floor, height);
    const std::vector<std::string> found = tags(all);
    for (const std::size_t room : {0u, 6u}) {
      EXPECT_EQ(found[room], "floor") << floor;
      EXPECT_EQ(found[room + 1], "ceiling") << floor;
      for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(found[room + i], "wall") << floor;
    }
  }
}

/// Rooms beside each other are one floor and one ceiling if they are level, and one of them is not quite.
TEST(Tags, OfASmallRoomBesideALargeFloor) {
  Arrangement all;
  add(all, {-30, 0, 0}, Vec3(29.8, 0, 0), Vec3(0, 12, 0));
  add(all, {-30, 0, 2.7}, Vec3(29.8, 0, 0), Vec3(0, 12, 0));
  add_room(all, 0, 0.01, 2.7);
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(found[2], "floor");
  EXPECT_EQ(found[3], "ceiling");
}

/// Which is seen better than the other is a matter of the scanner's place.
TEST(Tags, OfASmallRoomBesideAHighHall) {
  for (const bool more_ceiling : {false, true}) {
    Arrangement all;
    for (const double z : {0.0, 8.0}) add(all, {-20, 0, z}, Vec3(19.8, 0, 0), Vec3(0, 12, 0));
    for (const double y : {0.0, 12.0}) add(all, {-20, y, 0}, Vec3(19.8, 0, 0), Vec3(0, 0, 8));
    add_room(all, 0, 0.3, 2.7);
    all.planes[4].area = more_ceiling ? 19.9 : 20.0;
    all.planes[5].area = more_ceiling ? 20.0 : 19.9;
    if (more_ceiling) std::swap(all.planes[4], all.planes[5]);
    const std::vector<std::string> found = tags(all);
    EXPECT_EQ(found[more_ceiling ? 5 : 4], "floor");
    EXPECT_EQ(found[more_ceiling ? 4 : 5], "ceiling");
  }
}

TEST(Tags, ADeskBetweenWallsTakesNothingFromTheFloor) {
  Arrangement all;
  add_room(all, 0, 0, 2.5);
  add_room(all, 0, 2.8, 2.5);
  add(all, {1, 3.2, 3.55}, Vec3(2, 0, 0), Vec3(0, 0.8, 0));  // in an alcove of the upper one
  for (const double x : {1.0, 3.0}) add(all, {x, 3.2, 2.8}, Vec3(0, 0.8, 0), Vec3(0, 0, 2.5));
  const std::vector<std::string> found = tags(all);
  for (const std::size_t room : {0u, 6u}) {
    EXPECT_EQ(found[room], "floor");
    EXPECT_EQ(found[room + 1], "ceiling");
  }
  EXPECT_EQ(found[12], "horizontal");
}

TEST(Tags, AShelterOnALotHasNoCeiling) {
  Arrangement all;
  add(all, {-40, -40, 0}, Vec3(80, 0, 0), Vec3(0, 80, 0));
  add(all, {0, 0, 2.4}, Vec3(14, 0, 0), Vec3(0, 14, 0));
  add(all, {0, 0, 0}, Vec3(14, 0, 0), Vec3(0, 0, 2.4));
  for (const double x : {0.0, 14.0}) add(all, {x, 0, 0}, Vec3(0, 14, 0), Vec3(0, 0, 2.4));
  EXPECT_EQ(tags(all)[1], "horizontal");
}

TEST(Tags, ABedInACornerIsNoFloor) {
  Arrangement all;
  add_room(all, 0, 0, 2.7);
  all.planes[0].polygon = {{{2, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0}, {0, 2.2, 0}, {2, 2.2, 0}}};
  add(all, {0, 0, 0.6}, Vec3(2, 0, 0), Vec3(0, 2.2, 0));  // in a corner, and nothing seen below
  add(all, {2, 0, 0}, Vec3(0, 2.2, 0), Vec3(0, 0, 0.6));
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(found[0], "floor");
  EXPECT_EQ(found[6], "horizontal");
}

TEST(Tags, AFlatRoofSeenFromOutsideIsNoCeiling) {
  Arrangement all;
  add(all, {-20, -20, 0}, Vec3(50, 0, 0), Vec3(0, 50, 0));
  all.planes[0].polygon.push_back({{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}});
  add(all, {0, 0, 4}, Vec3(10, 0, 0), Vec3(0, 8, 0));
  for (const double y : {0.0, 8.0}) add(all, {0, y, 0}, Vec3(10, 0, 0), Vec3(0, 0, 4));
  for (const double x : {0.0, 10.0}) add(all, {x, 0, 0}, Vec3(0, 8, 0), Vec3(0, 0, 4));
  add(all, {-20, 25, 0}, Vec3(50, 0, 0), Vec3(0, 0, 9));  // of a house behind
  const std::vector<std::string> found = tags(all);
  EXPECT_EQ(found[0], "floor");
  EXPECT_EQ(found[1], "horizontal");
}

TEST(Tags, AScanThatIsTurnedIsSaidToBe) {
  EXPECT_EQ(warnings_of_up(Mat3::Identity()), 0u);
  EXPECT_EQ(warnings_of_up(Eigen::AngleAxisd(0.5, Vec3::UnitZ()).matrix()), 0u);
  EXPECT_EQ(warnings_of_up(Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).matrix()), 1u);
  EXPECT_EQ(warnings_of_up((Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()) * Eigen::AngleAxisd(0.3, Vec3::UnitZ())).matrix()), 1u) << "y is up, walls askew";
}

/// Level planes 0.1 m apart, of whose points the first lie on theirs, the second beside it, and of the third there are two.
TEST(Describe, LeavesOutWhatLiesOffItsPointsOrHasNone) {
  PointCloud cloud;
  Random random(1);
  Model model;
  model.frames = {{Mat3::Identity(), true}};
  model.locals = {Vec3::UnitZ()};
  std::vector<Moments> sums;
  const std::array<double, 3> off = {0.0, 0.012, 0.0}, count = {100, 100, 2};
  for (int i = 0; i < 3; ++i) {
    test::add_rectangle(cloud, {0, 0, 0.1 * i + 0.005}, {1, 0, 0}, {0, 1, 0}, 0.01, 0.0, random);
    model.surfaces.push_back({0, 0, {}, 0.1 * i + 0.005});
    model.parts.push_back({i, {}});
    sums.push_back({count[static_cast<std::size_t>(i)], Vec3(0.5, 0.5, 0.1 * i + 0.005 + off[static_cast<std::size_t>(i)]), Mat3::Zero()});
  }
  VoxelGrid grid = test::grid_of(cloud, 0.01);
  grid.tolerance = 0.01;
  for (std::size_t v = 0; v < grid.size(); ++v) model.parts[static_cast<std::size_t>(std::lround(10 * grid.moments[v].mean.z()))].cells.push_back(static_cast<int>(v));
  Cells cells;
  cells.tolerance.assign(grid.size(), grid.tolerance);
  Arrangement result;
  EXPECT_EQ(describe_planes(model, sums, grid, cells, {}, result, Context()), (std::vector<int>{0, -1, -1}));
  ASSERT_EQ(result.planes.size(), 1u);
  EXPECT_NEAR(result.planes[0].area, 1.0, 0.05);
}

}  // namespace
}  // namespace unseen::planes
