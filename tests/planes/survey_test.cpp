// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <functional>

#include "planes/scan/scale.h"
#include "planes/scenes.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

Survey look_at(const PointCloud& cloud) {
  CloudSource source(cloud);
  Context context;
  return survey(source, context);
}

PointCloud scattered(std::size_t count, std::uint64_t seed) {
  PointCloud cloud;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i)
    cloud.positions.emplace_back(random.uniform(-1, 3), random.uniform(0, 2), random.uniform(0, 1));
  return cloud;
}

TEST(Survey, CountsWhatItSees) {
  PointCloud cloud = scattered(100, 1);
  cloud.normals.assign(100, Vec3f(0, 0, 1));
  cloud.normals[3].setZero();
  cloud.normals[4].setConstant(std::nanf(""));
  cloud.positions[7].x() = std::nan("");
  cloud.positions[8] = {-5, 6, 0.5};
  const Survey s = look_at(cloud);
  EXPECT_EQ(s.points, 100u);
  EXPECT_EQ(s.finite, 99u);
  EXPECT_EQ(s.duplicates, 0u);
  EXPECT_EQ(s.without_normal, 2u);
  EXPECT_EQ(s.low.x(), -5);
  EXPECT_EQ(s.high.y(), 6);
  EXPECT_EQ(s.sample.size(), 99u);
  EXPECT_EQ(s.share, 1.0);
}

TEST(Survey, OneOfEachGroupOfTwinsStays) {
  PointCloud cloud = scattered(50, 2);
  cloud.positions[10] = cloud.positions[40] = cloud.positions[20];
  cloud.positions[30] = {0.0, 1.0, 0.0};
  cloud.positions[31] = {-0.0, 1.0, -0.0};  // the same place
  const Survey s = look_at(cloud);
  EXPECT_EQ(s.duplicates, 3u);
  ASSERT_EQ(s.duplicate.size(), 50u);
  EXPECT_EQ(s.duplicate[10] + s.duplicate[20] + s.duplicate[40], 2);
  EXPECT_EQ(s.duplicate[30] + s.duplicate[31], 1);
  EXPECT_EQ(std::count(s.duplicate.begin(), s.duplicate.end(), true), 3);
  EXPECT_EQ(s.sample.size(), 47u);
}

/// Files are streamed: twins are found there too, and the sample that the scale is taken from holds none.
TEST(Survey, FindsTwinsInAStream) {
  const PointCloud once = scattered(4000, 3);
  PointCloud thrice;
  for (int k = 0; k < 3; ++k)
    thrice.positions.insert(thrice.positions.end(), once.positions.begin(), once.positions.end());
  test::Stream stream(thrice, false, 1000);
  Context context;
  const Survey s = survey(stream, context);
  EXPECT_EQ(s.duplicates, 8000u);
  EXPECT_EQ(std::count(s.duplicate.begin(), s.duplicate.end(), false), 4000);
  EXPECT_TRUE(s.sample == look_at(once).sample);
}

/// Which twin stays shows in its normal: it must be the same one in any order.
TEST(Survey, TheTwinThatStaysDoesNotDependOnTheOrder) {
  PointCloud cloud = scattered(60, 3);
  for (std::size_t i = 0; i < 60; ++i) cloud.normals.push_back(Random(i + 1).direction().cast<float>());
  for (std::size_t i = 0; i < 20; ++i)
    cloud.positions[3 * i + 1] = cloud.positions[3 * i + 2] = cloud.positions[3 * i];
  const auto stay = [](const PointCloud& c) {
    const Survey s = look_at(c);
    std::vector<std::array<float, 3>> normals;
    for (std::size_t i = 0; i < c.size(); ++i)
      if (!s.duplicate[i]) normals.push_back({c.normals[i].x(), c.normals[i].y(), c.normals[i].z()});
    std::sort(normals.begin(), normals.end());
    return normals;
  };
  const auto expected = stay(cloud);
  EXPECT_EQ(expected.size(), 20u);
  for (const std::uint64_t seed : {1u, 2u, 3u})
    EXPECT_EQ(stay(test::reordered(cloud, test::shuffled(60, seed))), expected);
}

TEST(Survey, SampleIsBoundedEvenAndIndependentOfTheOrder) {
  const PointCloud cloud = scattered(700'000, 4);
  const Survey s = look_at(cloud);
  EXPECT_LE(s.sample.size(), 300'000u);
  EXPECT_GT(s.sample.size(), 100'000u);
  EXPECT_NEAR(s.share, s.sample.size() / 700'000.0, 1e-12);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : s.sample) mean += p / static_cast<double>(s.sample.size());
  EXPECT_LT((mean - Vec3(1, 1, 0.5)).norm(), 0.01);
  const Survey t = look_at(test::reordered(cloud, test::shuffled(cloud.size(), 5)));
  EXPECT_TRUE(s.sample == t.sample);
}

TEST(Survey, WithoutAFinitePointIsAnError) {
  PointCloud none;
  EXPECT_THROW(look_at(none), InputError);
  none.positions.assign(5, Vec3::Constant(std::nan("")));
  EXPECT_THROW(look_at(none), InputError);
}

TEST(SpaceOf, NoticesDrawingsInEachCoordinatePlane) {
  for (int axis = 0; axis < 3; ++axis) {
    PointCloud cloud = scattered(100, 6);
    for (Vec3& p : cloud.positions) p[axis] = 12.5;
    const Space space = space_of(look_at(cloud), false);
    ASSERT_TRUE(space.is_2d());
    EXPECT_EQ(*space.flat_axis, Vec3::Unit(axis));
    cloud.positions[50][axis] += 1e-6;
    EXPECT_FALSE(space_of(look_at(cloud), false).is_2d());
  }
  EXPECT_EQ(*space_of(look_at(scattered(10, 7)), true).flat_axis, Vec3(Vec3::UnitZ()));
}

/// A flat cloud is a drawing if it consists of lines, however thick, and a plane if it fills an area.
TEST(SpaceOf, AFilledAreaIsNoDrawing) {
  for (const std::size_t count : {1000u, 20'000u, 400'000u}) {
    PointCloud area = scattered(count, 9), lines = area;
    Random random(10);
    for (Vec3& p : area.positions) p.z() = 0;
    for (Vec3& p : lines.positions) {
      const double t = random.uniform(0, 3), d = random.normal() * 0.02;
      p = random.uniform() < 0.5 ? Vec3(t, random.uniform() < 0.5 ? d : 2 + d, 0)
                                 : Vec3(random.uniform() < 0.5 ? d : 3 + d, 2 * t / 3, 0);
    }
    EXPECT_FALSE(space_of(look_at(area), false).is_2d()) << count;
    EXPECT_TRUE(space_of(look_at(lines), false).is_2d()) << count;
  }
}

/// Walls between two cuts are a drawing; what a scanner's rings leave of level or falling ground is a surface, and a rail no slice.
TEST(SpaceOf, ASliceThroughWallsIsADrawing) {
  Random random(11);
  const auto cloud_of = [](const std::function<Vec3()>& point) {
    PointCloud cloud;
    for (int i = 0; i < 20'000; ++i) cloud.positions.push_back(point());
    return cloud;
  };
  const auto on_walls = [&](double thick) -> Vec3 {
    const double t = random.uniform(0, 8), noise = 0.003 * random.normal();
    return Vec3(random.uniform() < 0.5 ? Vec3(t, random.uniform() < 0.5 ? noise : 6 + noise, 0) : Vec3(random.uniform() < 0.5 ? noise : 8 + noise, 0.75 * t, 0)) +
           Vec3(0, 0, random.uniform(0, thick));
  };
  const auto on_rings = [&] {
    const double angle = random.uniform(0, 2 * kPi), radius = 4.0 * (1 + static_cast<double>(random.index(4)));
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  const auto is_2d = [&](const PointCloud& cloud) { return space_of(look_at(cloud), false).is_2d(); };
  EXPECT_TRUE(is_2d(cloud_of([&] { return on_walls(0.02); })));
  EXPECT_TRUE(is_2d(cloud_of([&] { return on_walls(0.05); })));  // of which strips would be left that are too low for planes
  EXPECT_FALSE(is_2d(cloud_of([&] { return on_walls(0.3); })));
  EXPECT_FALSE(is_2d(cloud_of([&] { return Vec3(on_rings() + Vec3(0, 0, 0.01 * random.normal())); })));
  EXPECT_FALSE(is_2d(cloud_of([&] {  // tables of a solar park
    const double up = random.uniform(0, 1.5);
    return Vec3(40.0 * static_cast<double>(random.index(6)) + random.uniform(0, 20), 30.0 * static_cast<double>(random.index(7)) + 2 * up, up + 0.01 * random.normal());
  })));
  EXPECT_FALSE(is_2d(cloud_of([&] {  // a railing of round bars
    const double angle = random.uniform(0, 2 * kPi);
    return Vec3(0.125 * static_cast<double>(random.index(20)) + 0.0075 * std::cos(angle), random.uniform(0, 1.8), 0.0075 * std::sin(angle) + 0.0003 * random.normal());
  })));
  EXPECT_FALSE(is_2d(cloud_of([&] {
    const Vec3 p = on_rings();
    return Vec3(p.x(), p.y(), 0.003 * p.x() + 0.004 * random.uniform());
  })));
  EXPECT_FALSE(is_2d(cloud_of([&] {  // a dish
    const Vec3 p = on_rings();
    return Vec3(p.x(), p.y(), 0.12 * p.head<2>().squaredNorm() / 256 + 0.005 * random.normal());
  })));
  EXPECT_FALSE(is_2d(cloud_of([&] {  // a road and pavements
    const Vec3 p = on_rings();
    return Vec3(p.x(), p.y(), (std::abs(p.x()) > 5 ? 0.1 : 0.0) + 0.003 * random.normal());
  })));
  EXPECT_FALSE(is_2d(cloud_of([&] { return Vec3(on_rings() + Vec3(0, 0, 0.01 * static_cast<double>(random.index(3)))); })));  // in centimetres
  EXPECT_FALSE(is_2d(cloud_of([&] { return Vec3(random.uniform(0, 100), 0.3 * random.uniform(), 0.3 * static_cast<double>(random.index(2))); })));
}

/// A line along an axis is flat in two coordinates; it is no drawing.
TEST(SpaceOf, ALineIsNoDrawing) {
  PointCloud cloud = scattered(100, 8);
  for (Vec3& p : cloud.positions) p.y() = p.z() = 0;
  EXPECT_FALSE(space_of(look_at(cloud), false).is_2d());
}

TEST(NormalsUsable, OnlyIfTheyAgreeWithTheSurface) {
  PointCloud cloud = test::plane_cloud(0.02, 0.001);
  const auto usable = [&] {
    const Survey s = look_at(cloud);
    return normals_usable(s, {});
  };
  EXPECT_FALSE(usable());  // there are none
  const Vec3f n = Vec3f(-0.4f, 0, 2).normalized();
  cloud.normals.assign(cloud.size(), n);
  for (std::size_t i = 0; i < cloud.size(); i += 2) cloud.normals[i] *= -1;  // the sign says nothing
  EXPECT_TRUE(usable());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i % 10 < 6) cloud.normals[i].setZero();
  EXPECT_FALSE(usable());
  Random random(10);
  for (Vec3f& m : cloud.normals) m = random.direction().cast<float>();
  EXPECT_FALSE(usable());
}

}  // namespace
}  // namespace unseen::planes
