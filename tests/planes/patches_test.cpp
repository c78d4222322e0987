// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/patches.h"

#include <gtest/gtest.h>

#include <set>

#include "planes/scenes.h"
#include "planes/selection/frames.h"

namespace unseen::planes {
namespace {

constexpr double kScale = 0.1, kEdge = 0.05;
const double kAngle = radians(15.0);

struct Scene {
  VoxelGrid grid;
  Cells cells;
  Context context;
  Space space;

  explicit Scene(const PointCloud& cloud, const Space& s = {}) : grid(test::grid_of(cloud, kEdge)), space(s) {
    context.threads = 2;
    cells = estimate_normals(grid, space, context);
  }
  CellSets grow() { return grow_regions(grid, cells, space, kAngle, context); }
  CellSets all() const {
    std::vector<int> every(grid.size());
    std::iota(every.begin(), every.end(), 0);
    return {every};
  }
};

/// Two rectangles of 2 m × 1 m that meet along y, `angle` (deg) between their planes: 180 is one plane.
PointCloud hinge(double angle, double noise, double gap = 0.0) {
  PointCloud cloud;
  Random random(1);
  const double a = radians(angle);
  test::add_rectangle(cloud, {-2 - gap, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.02, noise, random);
  test::add_rectangle(cloud, {gap * std::cos(kPi - a), 0, gap * std::sin(kPi - a)},
                      2 * Vec3(std::cos(kPi - a), 0, std::sin(kPi - a)), {0, 1, 0}, 0.02, noise, random);
  return cloud;
}

void expect_disjoint_and_sorted(const CellSets& sets, std::size_t cells) {
  std::set<int> seen;
  for (const std::vector<int>& set : sets) {
    EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
    for (const int i : set) {
      EXPECT_TRUE(i >= 0 && i < static_cast<int>(cells));
      EXPECT_TRUE(seen.insert(i).second) << "voxel " << i << " is in two regions";
    }
  }
}

class Hinges : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Angles, Hinges, testing::Values(90.0, 120.0, 150.0, 60.0));

TEST_P(Hinges, MakeTwoPatches) {
  Scene scene(hinge(GetParam(), 0.003));
  const Patches p = segment(scene.grid, scene.cells, scene.space, kAngle, scene.context);
  ASSERT_EQ(p.patches.size(), 2u);
  EXPECT_NEAR(degrees(line_angle(p.patches[0].fit.normal, p.patches[1].fit.normal)),
              std::min(GetParam(), 180 - GetParam()), 1.0);
  CellSets sets = {p.patches[0].cells, p.patches[1].cells};
  expect_disjoint_and_sorted(sets, scene.grid.size());
  for (const Patch& patch : p.patches) {
    EXPECT_NEAR(patch.area, 2.0, 0.2);
    EXPECT_LT(patch.fit.rms, 0.006);
  }
  EXPECT_EQ(p.adjoining, (std::vector<std::pair<int, int>>{{0, 1}}));
  if (GetParam() <= 90.0) {
    EXPECT_TRUE(p.neighbours.empty());  // their normals differ by more than τ even where they meet
  }
  for (std::size_t i = 0; i < scene.grid.size(); ++i)
    for (int j = 0; j < 2; ++j)
      EXPECT_EQ(p.patch_of_cell[i] == j,
                std::binary_search(sets[j].begin(), sets[j].end(), static_cast<int>(i)));
}

/// A ramp: all of it lies within the tolerance of one plane through floor and ramp, but far beyond the noise.
TEST(Hinge, OfAFewDegreesMakesTwoPatches) {
  Scene scene(hinge(177, 0.002));
  const Patches p = segment(scene.grid, scene.cells, scene.space, kAngle, scene.context);
  ASSERT_EQ(p.patches.size(), 2u);
  EXPECT_NEAR(degrees(line_angle(p.patches[0].fit.normal, p.patches[1].fit.normal)), 3.0, 0.3);
  for (const Patch& patch : p.patches) EXPECT_NEAR(patch.area, 2.0, 0.3);
}

TEST(Grow, TwoPlanesBecomeTwoRegions) {
  for (const double angle : {90.0, 150.0}) {
    Scene scene(hinge(angle, 0.003));
    CellSets regions = scene.grow();
    expect_disjoint_and_sorted(regions, scene.grid.size());
    std::sort(regions.begin(), regions.end(),
              [](const auto& a, const auto& b) { return a.size() > b.size(); });
    ASSERT_GE(regions.size(), 2u);
    const double each = 0.38 * static_cast<double>(scene.grid.size());
    EXPECT_GT(regions[0].size(), each);
    EXPECT_GT(regions[1].size(), each);
  }
}

/// A gap within the reach does not cut a plane, a wider one does.
TEST(Grow, ReachesOverSmallGapsOnly) {
  EXPECT_EQ(Scene(hinge(180, 0.003, 0.02)).grow().size(), 1u);
  EXPECT_EQ(Scene(hinge(180, 0.003, 0.15)).grow().size(), 2u);
}

TEST(Grow, ABlobIsNoSurface) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 500; ++i)
    cloud.positions.emplace_back(0.08 * random.normal(), 0.08 * random.normal(), 0.08 * random.normal());
  double most = 0;
  Scene scene(cloud);
  for (const auto& region : scene.grow()) most = std::max(most, static_cast<double>(region.size()));
  EXPECT_LT(most, 0.2 * static_cast<double>(scene.grid.size()));
}

/// One set over an edge, as a plane that cuts the corner has it, is cut where the planes meet.
TEST(Split, ACornerIsNotCut) {
  for (const double angle : {90.0, 150.0}) {
    Scene scene(hinge(angle, 0.003));
    CellSets parts = split_regions(scene.grid, scene.space, scene.all(), scene.context);
    expect_disjoint_and_sorted(parts, scene.grid.size());
    std::size_t cells = 0;
    for (const auto& part : parts) cells += part.size();
    EXPECT_EQ(cells, scene.grid.size());
    std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    ASSERT_GE(parts.size(), 2u);
    for (int k = 0; k < 2; ++k) {
      const Patch patch = make_patch(scene.grid, scene.space, parts[k], 0.0);
      const bool flat = line_angle(patch.fit.normal, Vec3::UnitZ()) < radians(2);
      const bool tilted =
          std::abs(degrees(line_angle(patch.fit.normal, Vec3::UnitZ())) - std::min(angle, 180 - angle)) < 2;
      EXPECT_TRUE(flat || tilted) << degrees(line_angle(patch.fit.normal, Vec3::UnitZ()));
    }
  }
}

TEST(Split, OnePlaneStaysWhole) {
  Scene scene(hinge(180, 0.02));
  EXPECT_EQ(split_regions(scene.grid, scene.space, scene.all(), scene.context).size(), 1u);
}

CellSets halves(const Scene& scene) {
  CellSets sets(2);
  for (std::size_t i = 0; i < scene.grid.size(); ++i)
    sets[scene.grid.moments[i].mean.x() < 0 ? 0 : 1].push_back(static_cast<int>(i));
  return sets;
}

TEST(Merge, HalvesOfOnePlaneJoinAndHingesDoNot) {
  Scene flat(hinge(180, 0.005));
  EXPECT_EQ(merge_regions(flat.grid, flat.cells, flat.space, kAngle, halves(flat), flat.context).size(), 1u);
  for (const double angle : {90.0, 150.0, 170.0}) {
    Scene bent(hinge(angle, 0.005));
    EXPECT_EQ(merge_regions(bent.grid, bent.cells, bent.space, kAngle, halves(bent), bent.context).size(),
              2u);
  }
}

TEST(Merge, ParallelStepsStayApart) {
  PointCloud cloud;
  Random random(3);
  test::add_rectangle(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.003, random);
  test::add_rectangle(cloud, {1, 0, 0.08}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.003, random);
  Scene scene(cloud);
  CellSets sets(2);
  for (std::size_t i = 0; i < scene.grid.size(); ++i)
    sets[scene.grid.moments[i].mean.x() < 1 ? 0 : 1].push_back(static_cast<int>(i));
  EXPECT_EQ(merge_regions(scene.grid, scene.cells, scene.space, kAngle, sets, scene.context).size(), 2u);
}

/// A strip that bevels an edge by less than the scale is the edge; a shelf beside a wall is not.
TEST(DropRims, RimsGoAndStructuresStay) {
  PointCloud cloud;
  Random random(4);
  test::add_rectangle(cloud, {0.05, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02, 0.0, random);
  test::add_rectangle(cloud, {0, 0, 0.05}, {0, 0, 1}, {0, 1, 0}, 0.02, 0.0, random);
  test::add_rectangle(cloud, {0.05, 0, 0}, {-0.05, 0, 0.05}, {0, 1, 0}, 0.01, 0.0, random);
  test::add_rectangle(cloud, {0, 0, 1.0}, {0.4, 0, 0}, {0, 1, 0}, 0.02, 0.0, random);
  Scene scene(cloud);
  CellSets sets(4);  // floor, wall, bevel, shelf
  for (std::size_t i = 0; i < scene.grid.size(); ++i) {
    const Vec3& p = scene.grid.moments[i].mean;
    const int set = p.z() > 0.98 ? 3 : p.x() < 0.06 && p.z() < 0.06 ? 2 : p.x() < 0.02 ? 1 : 0;
    sets[set].push_back(static_cast<int>(i));
  }
  for (const auto& set : sets) ASSERT_GT(set.size(), 10u);
  const std::vector<int> bevel = sets[2];
  const CellSets kept = drop_rims(scene.grid, scene.cells, scene.space, sets, scene.context);
  EXPECT_EQ(kept.size(), 3u);
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), bevel) == kept.end());
}

/// A ridge is no plane of its own though something stands on a third of it; a ramp is one though most of it lies within the scale over the floor.
TEST(DropRims, WhatOthersExplainBetterGoes) {
  PointCloud cloud;
  Random random(4);
  test::add_rectangle(cloud, {0, 0, 0}, {-0.7, 0, -0.7}, {0, 1, 0}, 0.02, 0.0, random);
  test::add_rectangle(cloud, {0, 0, 0}, {0.7, 0, -0.7}, {0, 1, 0}, 0.02, 0.0, random);
  test::add_rectangle(cloud, {-0.05, 0.7, 0.15}, {0.1, 0, 0}, {0, 0.3, 0}, 0.015, 0.0, random);
  test::add_rectangle(cloud, {1, 0, -1}, {2, 0, 0}, {0, 1, 0}, 0.02, 0.0, random);
  test::add_rectangle(cloud, {1.5, 0.5, -1}, {1, 0, 0.16}, {0, 0.1, 0}, 0.02, 0.0, random);
  Scene scene(cloud);
  CellSets sets(5);  // two roofs, the ridge, the floor, the ramp
  for (std::size_t i = 0; i < scene.grid.size(); ++i) {
    const Vec3& p = scene.grid.moments[i].mean;
    const bool ramp = p.x() > 1.6 && p.z() > -0.99;
    sets[p.x() > 0.8 ? (ramp ? 4 : 3) : p.z() > -0.06 ? 2 : p.x() < 0 ? 0 : 1].push_back(static_cast<int>(i));
  }
  const std::vector<int> ridge = sets[2], ramp = sets[4];
  const CellSets kept = drop_rims(scene.grid, scene.cells, scene.space, sets, scene.context);
  EXPECT_EQ(kept.size(), 4u);
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), ridge) == kept.end());
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), ramp) != kept.end());
}

/// Single points on either side of a surface go; its own noise and what stands on it stay.
TEST(DropStrays, OutliersGoAndNoiseStays) {
  PointCloud cloud;
  Random random(4);
  test::add_rectangle(cloud, {0, 0, 0.025}, {2, 0, 0}, {0, 1, 0}, 0.05, 0.002, random);
  const std::size_t surface = cloud.size();
  for (int i = 0; i < 40; ++i)
    cloud.positions.emplace_back(0.05 * (i % 8) * 5 + 0.02, 0.05 * (i / 8) * 4 + 0.02, i % 3 == 0 ? 0.06 : -0.03);
  const std::size_t strays = cloud.size() - surface;
  test::add_rectangle(cloud, {0.5, 0.98, 0.06}, {0.4, 0, 0}, {0, 0.02, 0}, 0.05, 0.0, random);  // a ledge
  Scene scene(cloud);
  const CellSets kept = drop_strays(scene.grid, scene.space, scene.all(), scene.context);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_TRUE(std::is_sorted(kept[0].begin(), kept[0].end()));
  EXPECT_NEAR(sum_of(scene.grid, kept[0]).count, static_cast<double>(cloud.size() - strays), 0.01 * static_cast<double>(surface));
  double above = 0, below = 0;
  for (const int i : kept[0]) {
    above += scene.grid.moments[i].mean.z() > 0.05 ? 1 : 0;
    below += scene.grid.moments[i].mean.z() < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(below, 0);
  EXPECT_GE(above, 6);  // the ledge
  EXPECT_EQ(drop_strays(scene.grid, scene.space, kept, scene.context), kept);
}

/// The stated variance of a tilt against the scatter of fits over many draws of the same noise.
TEST(MakePatch, TiltVarianceIsThatOfRepeatedScans) {
  double observed_u = 0, observed_v = 0, stated_u = 0, stated_v = 0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    PointCloud cloud;
    Random random(100 + draw);
    test::add_rectangle(cloud, {0, 0, 0.025}, {2, 0, 0}, {0, 0.8, 0}, 0.04, 0.004, random);
    const VoxelGrid grid = test::grid_of(cloud, kEdge);
    std::vector<int> all(grid.size());
    std::iota(all.begin(), all.end(), 0);
    const Patch patch = make_patch(grid, {}, all, 0.0);
    EXPECT_NEAR(patch.area, 1.6, 0.1);
    observed_u += std::pow(patch.fit.normal.x(), 2) / kDraws;
    observed_v += std::pow(patch.fit.normal.y(), 2) / kDraws;
    stated_u += patch.variance_u / kDraws;
    stated_v += patch.variance_v / kDraws;
    EXPECT_GE(patch.doubt_u, patch.variance_u);
    EXPECT_GE(patch.doubt_v, patch.variance_v);
  }
  EXPECT_GT(stated_u / observed_u, 0.6);
  EXPECT_LT(stated_u / observed_u, 2.0);
  EXPECT_GT(stated_v / observed_v, 0.6);
  EXPECT_LT(stated_v / observed_v, 2.0);
}

/// A crown that hangs over a roof, no more than the tolerance away, does not turn its plane.
TEST(MakePatch, WhatHangsOverAPlaneDoesNotTurnIt) {
  PointCloud cloud;
  Random random(8);
  test::add_rectangle(cloud, {0, 0, 0.25}, {8, 0, 0}, {0, 4, 0}, 0.5, 0.02, random);
  for (int i = 0; i < 30; ++i) cloud.positions.emplace_back(3 + 2 * random.uniform(), 2 * random.uniform(), 0.6 + 0.6 * random.uniform());
  const VoxelGrid grid = test::grid_of(cloud, 0.6);
  std::vector<int> all(grid.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_GT(degrees(line_angle(fit_plane(sum_of(grid, all), {}).normal, Vec3::UnitZ())), 1.0);
  const Patch patch = make_patch(grid, {}, all, 0.0);
  EXPECT_LT(degrees(line_angle(patch.fit.normal, Vec3::UnitZ())), 0.3);
  EXPECT_EQ(patch.cells.size(), grid.size());
}

/// A wall of 10 m with so many levels of equal height, each `step` (m) behind the one below, and one plane for all of it.
Patch patch_of_levels(int levels, double step, bool with_normals) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < levels; ++i) test::add_rectangle(cloud, {step * i, 0, 10.0 * i / levels}, {0, 10, 0}, {0, 0, 10.0 / levels}, 0.1, 0.01, random);
  VoxelGrid grid = test::grid_of(cloud, 0.15);
  grid.tolerance = 0.3;
  Context context;
  const Cells cells = estimate_normals(grid, {}, context);
  std::vector<int> all(grid.size());
  std::iota(all.begin(), all.end(), 0);
  return make_patch(grid, {}, all, 0.0, with_normals ? cells : Cells());
}

// Points of a wall that steps back as it rises lean, and its surface does not.
TEST(MakePatch, StepsInASurfaceAreNoLean) {
  constexpr double kSignificant = 9.0;  // χ²
  const Patch naive = patch_of_levels(3, 0.15, false), patch = patch_of_levels(3, 0.15, true);
  EXPECT_GT(degrees(line_angle(patch.fit.normal, Vec3::UnitX())), 1.5);
  EXPECT_GT(tilt_chi2(naive, Vec3::UnitX()), kSignificant);
  EXPECT_LT(tilt_chi2(patch, Vec3::UnitX()), kSignificant);
  EXPECT_LT(noise_chi2(patch, Vec3::UnitX()), kCertain);
  const Patch many = patch_of_levels(6, 0.1, true), flat = patch_of_levels(1, 0.0, true);
  EXPECT_GT(tilt_chi2(many, Vec3::UnitX()), kSignificant);  // what has so many steps does lean
  EXPECT_DOUBLE_EQ(flat.doubt_u, patch_of_levels(1, 0.0, false).doubt_u);
  EXPECT_DOUBLE_EQ(flat.doubt_v, patch_of_levels(1, 0.0, false).doubt_v);
}

TEST(Patches, ASweepThatIsFlatByNatureIsNotTrusted) {
  // A scanner's sweep: points along a line, noisy along the ray only, so that they lie exactly in a plane that
  // has nothing to do with the surface.
  PointCloud cloud;
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double noise = 0.005 * random.normal();
    cloud.positions.emplace_back(0.01 * i, noise, 0.3 * noise);
  }
  const VoxelGrid grid = test::grid_of(cloud, 0.05);
  std::vector<int> all(grid.size());
  std::iota(all.begin(), all.end(), 0);
  constexpr double kNoise = 0.0025;
  const Patch naive = make_patch(grid, {}, all, 0.0), patch = make_patch(grid, {}, all, kNoise);
  ASSERT_LT(naive.fit.rms, 1e-6);
  const double expected = kNoise / (std::sqrt(60.0) * patch.fit.spread_v);  // of a plane fitted to a strip so wide
  EXPECT_LT(std::sqrt(naive.variance_v), 0.01 * expected);
  EXPECT_NEAR(std::sqrt(patch.variance_v), expected, 0.01 * expected);
}

}  // namespace
}  // namespace unseen::planes
