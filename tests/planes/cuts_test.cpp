// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/cuts.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// A plane of 12 m by 4 m whose height is that of `profile`, with this noise, m.
VoxelGrid strip(const std::function<double(double, double)>& profile, double noise) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0, 12), y = random.uniform(0, 4);
    cloud.positions.push_back({x, y, profile(x, y) + noise * random.normal()});
  }
  return test::grid_of(cloud, 0.1);
}

/// The cut of a strip along x: where the voxels of its two sides lie, dm, ascending.
std::pair<std::vector<int>, std::vector<int>> cut_of_strip(const std::function<double(double)>& profile) {
  const VoxelGrid grid = strip([&](double x, double) { return profile(x); }, 0.005);
  CellSets sides = test::pieces_of(grid);
  if (sides.empty()) return {};
  for (std::vector<int>& side : sides) {
    for (int& voxel : side) voxel = static_cast<int>(std::lround(10 * grid.moments[voxel].mean.x()));
    std::sort(side.begin(), side.end());
  }
  EXPECT_EQ(sides.size(), 2u);
  return {sides[0], sides[1]};
}

/// 4 m up and 4 m down again, by a share `amount`.
double zigzag(double x, double amount) { return amount * std::abs(std::fmod(x + 2.0, 8.0) - 4.0); }

TEST(Cuts, WhatIsBentSeveralTimesIsCutAtABend) {
  const auto [a, b] = cut_of_strip([](double x) { return zigzag(x, 0.05); });
  ASSERT_FALSE(a.empty());
  const auto gap = [](const std::vector<int>& low, const std::vector<int>& high) { return std::min(std::abs(low.back() - high.front()), std::abs(high.back() - low.front())); };
  EXPECT_LE(gap(a, b), 2);
  const int at = std::max(a.front(), b.front());
  EXPECT_LE(std::min({std::abs(at - 20), std::abs(at - 60), std::abs(at - 100)}), 6) << at;
}

/// Where the two sides meet, dm.
int place_of_cut(const std::pair<std::vector<int>, std::vector<int>>& sides) {
  const auto& [a, b] = sides;
  return a.empty() ? 0 : std::max(a.front(), b.front());
}

// Faces at steps are parallel: no hinge tells them apart, and one plane over two equal steps is tilted, which a single cut does not mend.
TEST(Cuts, StepsAreCutWhereTheyAre) {
  EXPECT_NEAR(place_of_cut(cut_of_strip([](double x) { return x < 6.0 ? 0.0 : 0.05; })), 60, 5);
  const int at = place_of_cut(cut_of_strip([](double x) { return 0.05 * std::floor(x / 4.0); }));
  EXPECT_LE(std::min(std::abs(at - 40), std::abs(at - 80)), 5) << at;
  EXPECT_EQ(place_of_cut(cut_of_strip([](double x) { return x < 6.0 ? 0.0 : 0.01; })), 0) << "1 cm, at a noise of 5 mm";
}

TEST(Cuts, ManyStepsAreCutWhereTheyAre) {  // more than slices of the whole can tell
  for (const double tread : {2.4, 2.0, 1.5}) {
    const double at = 0.1 * place_of_cut(cut_of_strip([&](double x) { return 0.05 * std::floor(x / tread); }));
    EXPECT_GT(at, 0.0) << tread;
    EXPECT_LT(std::abs(std::remainder(at, tread)), 0.3) << tread << " " << at;
  }
}

TEST(Cuts, NoiseAndGentleWavesAreNotCut) {
  EXPECT_TRUE(cut_of_strip([](double) { return 0.0; }).first.empty());
  EXPECT_TRUE(cut_of_strip([](double x) { return zigzag(x, 0.008); }).first.empty()) << "bends of 0.9°";
  EXPECT_TRUE(cut_of_strip([](double x) { return 0.02 * std::sin(2.0 * kPi * x / 4.0); }).first.empty()) << "2 cm, at a tolerance of 20";
}

/// Whether (x, y) is on one of two panels of a roof, 6 m and 2 m long.
bool on_panel(double x, double y) { return y > 0.7 && y < 2.8 && ((x > 0.6 && x < 6.6) || (x > 8.5 && x < 10.5)); }

// No straight line parts panels from the roof around them; and one plane of both is tilted, as they do not lie in its middle.
TEST(Cuts, PanelsOnARoofAreIslands) {
  const VoxelGrid grid = strip([](double x, double y) { return on_panel(x, y) ? 0.12 : 0.0; }, 0.016);
  CellSets pieces = test::pieces_of(grid);
  ASSERT_EQ(pieces.size(), 3u);
  std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Moments sum = sum_of(grid, pieces[k]);
    EXPECT_NEAR(sum.mean.z(), k == 0 ? 0.0 : 0.12, 0.005);
    EXPECT_LT(line_angle(fit_plane(sum, {}).normal, Vec3::UnitZ()), radians(0.2));
  }
}

TEST(Cuts, TwoSidesThatLieAboveEachOtherAreParted) {
  Random random(3);  // where more than a few points lie higher, anywhere
  const VoxelGrid grid = strip([&](double, double) { return random.uniform() < 0.3 ? 0.15 : 0.0; }, 0.01);
  const CellSets pieces = test::pieces_of(grid);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(std::abs(sum_of(grid, pieces[0]).mean.z() - sum_of(grid, pieces[1]).mean.z()), 0.15, 0.01);
}

/// Seen from both sides, with a few points on its end: two planes, though no line parts their voxels and either explains the other's points.
TEST(Cuts, ThinWallsHaveTwoSides) {
  for (const double thick : {0.06, 0.075, 0.1}) {
    PointCloud cloud;
    Random random(7);
    const Vec3 along(std::cos(0.3), std::sin(0.3), 0), across(-std::sin(0.3), std::cos(0.3), 0), up(0, 0, 2.6);
    for (const double side : {0.0, thick}) test::add_rectangle(cloud, side * across, 4 * along, up, 0.05, 0.004, random);
    test::add_rectangle(cloud, 4 * along, thick * across, up, 0.03, 0.004, random);
    test::add_rectangle(cloud, Vec3(-4, -4, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), 0.06, 0.004, random);
    std::vector<double> sides;
    for (const ArrangedPlane& p : test::run(cloud, test::with_scale(0.11)).result.planes)
      if (line_angle(p.plane.normal, across) < radians(1) && p.points > 1'000) sides.push_back(p.plane.normal.dot(across) * p.plane.offset);
    ASSERT_EQ(sides.size(), 2u) << thick;
    EXPECT_NEAR(std::abs(sides[0] - sides[1]), thick, 0.004);
  }
}

TEST(Cuts, WhatIsRoughHasNoIslands) {
  EXPECT_TRUE(test::pieces_of(strip([](double, double) { return 0.0; }, 0.08)).empty());
  EXPECT_TRUE(test::pieces_of(strip([](double x, double y) { return on_panel(x, y) ? 0.06 : 0.0; }, 0.03)).empty()) << "two standard deviations";
  Random random(3);  // one point in ten lies higher, anywhere
  EXPECT_TRUE(test::pieces_of(strip([&](double, double) { return random.uniform() < 0.1 ? 0.15 : 0.0; }, 0.01)).empty());
}

}  // namespace
}  // namespace unseen::planes
