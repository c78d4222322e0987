// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Equal cartons side by side: nothing but the dark lines between them tells them apart.
#include <gtest/gtest.h>

#include "painted_scenes.h"

namespace unseen::cuboids::test {
namespace {

constexpr double kHalfLine = 0.002;  // m
constexpr Color kDark{0.02, 0.02, 0.02};
constexpr int kTop = 5;

bool near_any(double at, std::initializer_list<double> lines) {
  return std::any_of(lines.begin(), lines.end(), [&](double line) { return std::abs(at - line) < kHalfLine; });
}

std::size_t count_of(const Scene& scene, const std::function<Color(const Vec3&, int)>& paint) { return perceive(painted(scene, paint)).cuboids.size(); }

TEST(Seams, PartEqualCartons) {
  const Vec3 carton(0.2, 0.2, 0.18);
  const Scene row = wall(3, 1, carton);
  const std::vector<Cuboid> cartons = perceive(painted(row, [](const Vec3& p, int) { return near_any(p.x(), {-0.1, 0.1}) ? kDark : kBrown; })).cuboids;
  ASSERT_EQ(cartons.size(), 3u);
  for (const OrientedBox& box : row.boxes) EXPECT_LT(size_error(nearest(cartons, box.center).box, box), 0.012);
  EXPECT_EQ(count_of(row, [](const Vec3&, int) { return kBrown; }), 1u);
}

TEST(Seams, PartTheLayersOfAWallAndWhatIsInThem) {
  const Vec3 brick(0.2, 0.15, 0.1);
  const Scene scene = wall(3, 2, brick);
  Scene turned = scene;  // so that another side is seen
  const Mat3 turn = Eigen::AngleAxisd(radians(30.0), Vec3::UnitZ()).toRotationMatrix();
  const Vec3 about(0, 1.2, 0);
  for (OrientedBox& box : turned.boxes) box.axes = turn * box.axes, box.center = about + turn * (box.center - about);
  const std::vector<Cuboid> bricks = perceive(painted(turned, [&](const Vec3& p, int) {
                                       const Vec3 q = turn.transpose() * (p - about);
                                       return near_any(q.x(), {-0.1, 0.1}) || near_any(q.z(), {0.1}) ? kDark : kBrown;
                                     })).cuboids;
  ASSERT_EQ(bricks.size(), 6u);
  for (const OrientedBox& box : turned.boxes) {
    const OrientedBox& found = nearest(bricks, box.center).box;
    EXPECT_NEAR(2.0 * found.half_size.head<2>().maxCoeff(), 0.2, 0.015);
    EXPECT_NEAR(2.0 * found.half_size.z(), 0.1, 0.012);
  }
}

/// By depth alone it may as well be a box upon a wide one.
TEST(Seams, PartATallBoxFromTheLowOnesBesideIt) {
  Scene scene;
  scene.height = 0.8;
  scene.boxes = {upright(-0.2, 1.3, 0, {0.2, 0.2, 0.2}, 0), upright(0.0, 1.3, 0, {0.2, 0.2, 0.2}, 0), upright(0.2, 1.3, 0, {0.2, 0.2, 0.4}, 0)};
  const std::vector<Cuboid> found = perceive(painted(scene, [](const Vec3& p, int) { return near_any(p.x(), {-0.1, 0.1}) ? kDark : kWhite; })).cuboids;
  ASSERT_EQ(found.size(), 3u);
  for (const OrientedBox& box : scene.boxes) EXPECT_LT(size_error(nearest(found, box.center).box, box), 0.015);
}

TEST(Seams, AreNotWhatIsPrinted) {
  const Scene carton = wall(1, 1, {0.5, 0.3, 0.25});
  const auto is_front = [](int side) { return side != kTop; };
  EXPECT_EQ(count_of(carton, [&](const Vec3& p, int side) { return is_front(side) && near_any(p.x(), {-0.1, 0.1}) ? kDark : kBrown; }), 1u) << "doors";
  EXPECT_EQ(count_of(carton, [&](const Vec3& p, int side) { return side == kTop && near_any(p.x(), {0.0}) ? kDark : kBrown; }), 1u) << "flaps";
  EXPECT_EQ(count_of(carton, [&](const Vec3& p, int side) { return std::abs(p.x()) < 0.025 && (side == kTop || p.z() > 0.19) ? kYellow : kBrown; }), 1u) << "tape";
  EXPECT_EQ(count_of(carton, [&](const Vec3& p, int) { return near_any(p.x(), {-0.02, 0.02}) ? kDark : kBrown; }), 1u) << "ribbon";
  const auto printed = [](const Vec3& p, int side) {  // lines of print all over, those of the front as far apart as those of the top
    const double down = side == kTop ? p.y() : p.z();
    const bool line = static_cast<int>(std::floor(down / 0.012)) % 2 == 0, letter = static_cast<int>(std::floor(p.x() / 0.009 + 7.0 * std::floor(down / 0.024))) % 3 != 0;
    return line && letter ? kDark : kWhite;
  };
  EXPECT_EQ(count_of(carton, printed), 1u) << "print";
}

TEST(Seams, AreNotALidNorTheClosingLineOfASuitcase) {
  Scene box = wall(1, 1, {0.35, 0.25, 0.2});
  box.boxes.front().axes = Eigen::AngleAxisd(radians(35.0), Vec3::UnitZ()).toRotationMatrix();
  for (const double height : {0.165, 0.14})
    EXPECT_EQ(count_of(box, [&](const Vec3& p, int side) { return side != kTop && near_any(p.z(), {height}) ? kDark : kBrown; }), 1u) << height;
}

/// What is printed on one side stays so though a true seam parts the boxes that it is on.
TEST(Seams, BetweenChestsMakeNoneOfTheLinesOfTheirDrawersAndDoors) {
  const Scene row = wall(2, 1, {0.3, 0.25, 0.3});
  const auto chests = [](const Vec3& p, int side) { return near_any(p.x(), {0.0}) || (side != kTop && near_any(p.z(), {0.1, 0.2})) ? kDark : kWhite; };
  const auto doors = [](const Vec3& p, int side) { return near_any(p.x(), {0.0}) || (side != kTop && near_any(p.x(), {-0.15, 0.15})) ? kDark : kWhite; };
  const auto flaps = [](const Vec3& p, int side) { return near_any(p.x(), {0.0}) || (side == kTop && near_any(p.y(), {1.2})) ? kDark : kBrown; };
  EXPECT_EQ(count_of(row, chests), 2u);
  EXPECT_EQ(count_of(row, doors), 2u);
  EXPECT_EQ(count_of(row, flaps), 2u);
}

/// A box on it hides where the top would tell, but the camera is too low to see it anyway.
TEST(Seams, AreNotTheDoorsOfAWardrobe) {
  Scene scene;
  scene.height = 0.8;
  scene.pitch = radians(10.0);
  scene.boxes = {upright(0, 2.0, 0, {0.6, 0.4, 0.8}, 0), upright(0, 2.0, 0.8, {0.4, 0.38, 0.2}, 0)};
  EXPECT_EQ(count_of(scene, [](const Vec3& p, int) { return p.z() < 0.8 && near_any(p.x(), {0.0}) ? kDark : kWhite; }), 2u);
}

/// Less than 9 mm is a seam, more a strap, or a shadow.
TEST(Seams, AreNotStraps) {
  const Scene carton = wall(1, 1, {0.5, 0.3, 0.25});
  EXPECT_EQ(count_of(carton, [](const Vec3& p, int) { return std::abs(p.x()) < 0.01 ? Color{0.1, 0.06, 0.03} : kBrown; }), 1u);
}

}  // namespace
}  // namespace unseen::cuboids::test
