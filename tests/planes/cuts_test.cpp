// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/cuts.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// The cut of a strip along x whose height is that of `profile`: where the voxels of its sides lie, dm, ascending.
std::pair<std::vector<int>, std::vector<int>> cut_of_strip(const std::function<double(double)>& profile) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0, 12);
    cloud.positions.push_back({x, random.uniform(0, 4), profile(x) + 0.005 * random.normal()});
  }
  VoxelBuilder builder(0.1);
  builder.add(cloud);
  const VoxelGrid grid(builder);
  std::vector<int> region(grid.size());
  std::iota(region.begin(), region.end(), 0);
  auto sides = best_cut(grid, {}, region);
  for (std::vector<int>* side : {&sides.first, &sides.second}) {
    for (int& voxel : *side) voxel = static_cast<int>(std::lround(10 * grid.moments[voxel].mean.x()));
    std::sort(side->begin(), side->end());
  }
  return sides;
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

}  // namespace
}  // namespace unseen::planes
