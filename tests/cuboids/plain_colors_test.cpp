// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "cuboids/objects/tints.h"
#include "painted_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(PlainColors, PartFlushBoxes) {
  const Vec3 book(0.06, 0.16, 0.24);
  const Scene row = wall(4, 1, book);
  const std::array colors{kRed, kGreen, kBlue, kYellow};
  const std::vector<Cuboid> books = perceive(painted(row, [&](const Vec3& p, int) { return colors[std::clamp(static_cast<int>(std::floor(p.x() / book.x() + 2.0)), 0, 3)]; })).cuboids;
  ASSERT_EQ(books.size(), 4u);
  for (const OrientedBox& box : row.boxes) EXPECT_LT(size_error(nearest(books, box.center).box, box), 0.012);
  EXPECT_EQ(perceive(painted(row, [](const Vec3&, int) { return kBrown; })).cuboids.size(), 1u);
}

TEST(PlainColors, PartBricksOfAWall) {
  const Vec3 brick(0.2, 0.1, 0.09);
  const Scene scene = wall(3, 3, brick);
  const std::array colors{kRed, kGreen, kBlue, kYellow, kBrown};
  const std::vector<Cuboid> bricks = perceive(painted(scene, [&](const Vec3& p, int) {
                                       const int i = std::clamp(static_cast<int>(std::floor(p.x() / brick.x() + 1.5)), 0, 2), k = std::clamp(static_cast<int>(std::floor(p.z() / brick.z())), 0, 2);
                                       return colors[(i + 2 * k) % 5];
                                     })).cuboids;
  ASSERT_EQ(bricks.size(), 9u);
  for (const OrientedBox& box : scene.boxes) {
    const OrientedBox& found = nearest(bricks, box.center).box;
    EXPECT_NEAR(2.0 * found.half_size.head<2>().maxCoeff(), 0.2, 0.012);
    EXPECT_NEAR(2.0 * found.half_size.z(), 0.09, 0.012);
  }
}

/// One colour around another: of three equal boxes it is no band.
TEST(PlainColors, PartThreeEqualBoxesOfTwoColors) {
  const Scene row = wall(3, 1, {0.2, 0.2, 0.2}), stack = wall(1, 3, {0.25, 0.15, 0.1});
  EXPECT_EQ(perceive(painted(row, [](const Vec3& p, int) { return std::abs(p.x()) < 0.1 ? kBlue : kRed; })).cuboids.size(), 3u);
  EXPECT_EQ(perceive(painted(stack, [](const Vec3& p, int) { return std::abs(p.z() - 0.15) < 0.05 ? kBlue : kRed; })).cuboids.size(), 3u);
}

/// As many cubes of two colours by turns are no stripes.
TEST(PlainColors, PartCubesOfTwoColorsByTurns) {
  const Scene row = wall(4, 1, {0.15, 0.15, 0.15});
  const auto by_turns = [](const Vec3& p, int) { return static_cast<int>(std::floor((p.x() + 0.3) / 0.15)) % 2 == 0 ? kBlue : kRed; };
  EXPECT_EQ(perceive(painted(row, by_turns)).cuboids.size(), 4u);
}

/// White is the floor's grey in another light.
TEST(PlainColors, PartBoxesThatHaveTheColorOfTheFloor) {
  const Vec3 carton(0.16, 0.2, 0.18);
  const Scene row = wall(3, 1, carton);
  const std::vector<Cuboid> cartons = perceive(painted(row, [&](const Vec3& p, int side) {
                                        const bool label = side == 5 ? std::abs(p.y() - 1.2) < 0.04 : std::abs(p.z() - 0.09) < 0.03;
                                        if (std::abs(p.x()) < 0.08) return kWhite;
                                        return label && std::abs(std::abs(p.x()) - 0.16) < 0.03 ? kWhite : p.x() < 0.0 ? kRed : kBlue;
                                      })).cuboids;
  ASSERT_EQ(cartons.size(), 3u);
  for (const OrientedBox& box : row.boxes) EXPECT_LT(size_error(nearest(cartons, box.center).box, box), 0.012);
}

/// The depth alone joins some of one book's front to the book above it, and some to the one below.
TEST(PlainColors, PartAPileOfBooksNearlyInLine) {
  const std::array colors{kBlue, kYellow, kGreen, kRed};
  const std::array heights{0.049, 0.04, 0.038, 0.046};
  const std::array sizes{Vec2(0.27, 0.2), Vec2(0.244, 0.189), Vec2(0.221, 0.171), Vec2(0.206, 0.161)};
  int right = 0, piles = 0;
  for (const double yaw : {-28.0, -5.0, 10.0})
    for (const double turn : {-7.5, 4.0}) {
      Scene scene;
      scene.height = 0.5;
      scene.pitch = radians(30.0);
      scene.dropout = 1;
      double z = 0;
      for (int k = 0; k < 4; ++k, z += heights[k - 1])
        scene.boxes.push_back(upright(0.003 * (k % 3), 0.75 + 0.004 * (k % 2), z, {sizes[k].x(), sizes[k].y(), heights[k]}, k == 2 ? yaw + turn : yaw));
      const auto paint = [&](const Vec3& p, int) {
        int k = 0;
        for (double top = heights[0]; k < 3 && p.z() > top + 1e-4; top += heights[++k]) {}
        return colors[k];
      };
      const std::vector<Cuboid> books = perceive(painted(scene, paint)).cuboids;
      ++piles;
      right += books.size() == 4 && std::all_of(scene.boxes.begin(), scene.boxes.end(), [&](const OrientedBox& box) {
        return std::abs(nearest(books, box.center).box.half_size.z() - box.half_size.z()) < 0.006;
      });
    }
  EXPECT_GE(right, piles - 1);
}

/// It belongs to neither for sure.
TEST(PlainColors, PartNothingUnderALabelThatLiesOnTwo) {
  const Scene row = wall(2, 1, {0.2, 0.2, 0.2});
  const auto paint = [](const Vec3& p, int side) { return side != 5 && std::abs(p.x()) < 0.05 && std::abs(p.z() - 0.1) < 0.04 ? kWhite : p.x() < 0.0 ? kRed : kBlue; };
  EXPECT_EQ(perceive(painted(row, paint)).cuboids.size(), 1u);
}

/// A thin thing beside a thick one may be its end, but not what is beside the thin one.
TEST(PlainColors, PartThinThingsInARow) {
  Scene scene;
  scene.height = 0.8;
  scene.boxes = {upright(0, 1.2, 0, {0.24, 0.2, 0.2}, 0)};
  const std::array colors{kRed, kGreen, kBlue, kYellow};
  const auto paint = [&](const Vec3& p, int) { return colors[std::clamp(static_cast<int>(std::ceil((p.x() - 0.045) / 0.025)), 0, 3)]; };
  EXPECT_EQ(perceive(painted(scene, paint)).cuboids.size(), 3u);
}

/// Where the floor's colour is on a box, the others are not where they seem to be.
TEST(PlainColors, PartNothingInAPictureThatIsShifted) {
  const Scene row = wall(2, 1, {0.2, 0.2, 0.2});
  RgbdFrame frame = painted(row, [](const Vec3& p, int) { return p.x() < 0.0 ? kRed : kBlue; });
  const int width = frame.camera.width;
  for (std::size_t i = frame.color.size(); i-- > 0;) frame.color[i] = frame.color[i - std::min<std::size_t>(i, 14 * static_cast<std::size_t>(width) + 14)];
  EXPECT_EQ(perceive(frame).cuboids.size(), 1u);
}

/// Labels, bands, sides of other colours: one box all the same.
TEST(PlainColors, PrintsAreNoBoxes) {
  Scene scene;
  scene.height = 0.8;
  scene.boxes = {upright(0, 1.2, 0, {0.3, 0.2, 0.24}, 0)};
  const auto label = [](const Vec3& p, int side) { return side != 5 && std::abs(p.x()) < 0.08 && std::abs(p.z() - 0.12) < 0.06 ? kWhite : kRed; };
  const auto band = [](const Vec3& p, int) { return std::abs(p.x()) < 0.03 ? kBlue : kYellow; };
  const auto belt = [](const Vec3& p, int side) { return side != 5 && std::abs(p.z() - 0.12) < 0.02 ? kGreen : kRed; };
  const auto broad = [](const Vec3& p, int side) { return side != 5 && std::abs(p.z() - 0.12) < 0.05 ? kGreen : kRed; };
  const auto end = [](const Vec3& p, int) { return p.x() > 0.12 ? kBlue : kYellow; };
  const auto lid = [](const Vec3&, int side) { return side == 5 ? kBlue : kYellow; };
  const auto checks = [](const Vec3& p, int) { return (std::abs(p.x()) < 0.03) == (std::abs(p.z() - 0.12) < 0.04) ? kBlue : kYellow; };
  const auto stripes = [](const Vec3& p, int) { return static_cast<int>(std::floor((p.x() + 0.15) / 0.06)) % 2 == 0 ? kBlue : kYellow; };
  const auto belts = [](const Vec3& p, int) { return static_cast<int>(std::floor(p.z() / 0.04)) % 2 == 0 ? kRed : kGreen; };
  const auto spots = [](const Vec3& p, int) { return std::fmod(p.x() + p.y() + 10.0, 0.02) < 0.01 ? kBlue : kYellow; };
  const std::vector<std::pair<const char*, std::function<Color(const Vec3&, int)>>> paints{{"label", label}, {"band", band}, {"belt", belt}, {"broad belt", broad},
      {"end", end}, {"lid", lid}, {"checks", checks}, {"stripes", stripes}, {"belts", belts}, {"spots", spots}};
  for (const auto& [name, paint] : paints) {
    const std::vector<Cuboid> cuboids = perceive(painted(scene, paint)).cuboids;
    ASSERT_EQ(cuboids.size(), 1u) << name;
    EXPECT_LT(size_error(cuboids[0].box, scene.boxes[0]), 0.01) << name;
  }
}

TEST(Tints, AreThoseOfAnyLight) {
  RgbdFrame frame;
  frame.camera = {500, 500, 0, 0, 60, 20};
  const std::array colors{kRed, kGreen, kBlue, kYellow, kBrown, kWhite};
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 60; ++u) frame.color.push_back(srgb(colors[u / 10], v < 10 ? 1.0 : 0.4));
  const std::vector<Tint> tints = tints_of(frame);
  for (int k = 0; k < 6; ++k) {
    const Tint& light = tints[5 * 60 + 10 * k + 5];
    EXPECT_LT(difference(light, tints[15 * 60 + 10 * k + 5]), 1.5) << k;
    for (int j = 0; j < k; ++j) EXPECT_TRUE(are_other_tints(light, tints[5 * 60 + 10 * j + 5])) << j << " " << k;
  }
  frame.color.clear();
  EXPECT_TRUE(tints_of(frame).empty());
}

TEST(Tints, AreThoseOfCielab) {
  struct Known {
    std::array<std::uint8_t, 3> color;
    double l, a, b;  // of sRGB, D65
  };
  const std::array<Known, 5> known = {{{{255, 0, 0}, 53.24, 80.09, 67.20}, {{0, 255, 0}, 87.74, -86.18, 83.18}, {{0, 0, 255}, 32.30, 79.19, -107.86}, {{128, 128, 128}, 53.59, 0.0, 0.0},
                                       {{255, 255, 255}, 100.0, 0.0, 0.0}}};
  RgbdFrame frame;
  frame.camera.width = frame.camera.height = 3;
  for (const Known& one : known) {
    frame.color.assign(9, one.color);
    EXPECT_LT((tints_of(frame)[4] - 66.0 / (one.l + 16.0) * Tint(one.a, one.b)).norm(), 0.05) << one.l;
  }
}

TEST(Tints, OfPlainThingsAreKnown) {
  Observation seen;
  std::vector<int> points;
  for (int i = 0; i < 100; ++i) {
    points.push_back(i);
    seen.pixel_of_point.push_back(i);
    seen.tints.push_back(i < 15 ? Tint(40, 0) : Tint(0, 40));
  }
  ASSERT_TRUE(plain_tint(seen, points));
  EXPECT_EQ(*plain_tint(seen, points), Tint(0, 40));
  for (int i = 15; i < 40; ++i) seen.tints[i] = {40, 0};
  EXPECT_FALSE(plain_tint(seen, points));
  seen.tints.clear();
  EXPECT_FALSE(plain_tint(seen, points));
}

}  // namespace
}  // namespace unseen::cuboids::test
