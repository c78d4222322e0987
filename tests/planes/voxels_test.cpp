// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/voxels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "planes/scenes.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

/// Clustered points on both sides of zero, with normals of which some are unusable.
PointCloud sample(std::size_t count, std::uint64_t seed, const Vec3& origin = Vec3::Zero()) {
  PointCloud cloud;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.push_back(origin +
                              Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.1 * random.normal()));
    cloud.normals.push_back(i % 17 == 0 ? Vec3f(Vec3f::Zero()) : Vec3f(random.direction().cast<float>()));
  }
  return cloud;
}

template <class T>
bool same_bytes(const LargeVector<T>& a, const LargeVector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expect_same(const VoxelGrid& a, const VoxelGrid& b) {
  EXPECT_EQ(a.keys, b.keys);
  EXPECT_TRUE(same_bytes(a.moments, b.moments));
  EXPECT_TRUE(same_bytes(a.normals, b.normals));
}

TEST(Voxels, SumsDoNotDependOnTheOrderOfPoints) {
  const PointCloud cloud = sample(5000, 1);
  const VoxelGrid grid = test::grid_of(cloud, 0.1);
  ASSERT_FALSE(grid.normals.empty());
  for (const std::uint64_t seed : {2u, 3u})
    expect_same(grid, test::grid_of(test::reordered(cloud, test::shuffled(cloud.size(), seed)), 0.1));
}

TEST(Voxels, TilesJoinToTheSameSums) {
  const PointCloud cloud = sample(5000, 4);
  VoxelBuilder tiles[3] = {VoxelBuilder(0.1), VoxelBuilder(0.1), VoxelBuilder(0.1)};
  for (std::size_t i = 0; i < cloud.size(); ++i) {  // cut through voxels, and by point
    PointCloud one;
    one.positions = {cloud.positions[i]};
    one.normals = {cloud.normals[i]};
    tiles[cloud.positions[i].x() < 0.033 ? 0 : 1 + i % 2].add(one);
  }
  VoxelBuilder joined(0.1);
  for (const int t : {2, 0, 1}) joined.join(tiles[t]);
  expect_same(test::grid_of(cloud, 0.1), VoxelGrid(joined));
}

/// Count, mean and scatter of each voxel against the points that lie in it.
void expect_moments_of(const PointCloud& cloud, double edge, double tolerance) {
  const VoxelGrid grid = test::grid_of(cloud, edge);
  std::map<VoxelKey, std::vector<Vec3>> inside;
  for (const Vec3& p : cloud.positions)
    inside[{static_cast<std::int32_t>(std::floor(p.x() / edge)),
            static_cast<std::int32_t>(std::floor(p.y() / edge)),
            static_cast<std::int32_t>(std::floor(p.z() / edge))}]
        .push_back(p);
  ASSERT_EQ(grid.size(), inside.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::vector<Vec3>& points = inside.at(grid.keys[i]);
    const Vec3 near = grid.center_of(grid.keys[i]);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += (p - near) / static_cast<double>(points.size());
    Mat3 scatter = Mat3::Zero();
    for (const Vec3& p : points) scatter += (p - near - mean) * (p - near - mean).transpose();
    const Moments& m = grid.moments[i];
    EXPECT_EQ(m.count, static_cast<double>(points.size()));
    EXPECT_LT((m.mean - near - mean).norm(), tolerance * edge);
    EXPECT_LT((m.scatter - scatter).norm(), tolerance * edge * edge * m.count);
  }
}

TEST(Voxels, MomentsAreThoseOfThePointsInside) {
  expect_moments_of(sample(3000, 5), 0.125, 1e-5);
}

TEST(Voxels, UtmCoordinatesLoseNothing) {
  // A double has a resolution of 10⁻⁹ m at 5·10⁶ m; that is all that may get lost.
  expect_moments_of(sample(3000, 6, {432'105.25, 5'411'903.75, 312.5}), 0.125, 2e-5);
}

TEST(Voxels, NegativeCoordinatesRoundDown) {
  PointCloud cloud;
  cloud.positions = {{-0.01, 0.01, -1.0}, {0.01, -0.01, -1.01}};
  const VoxelGrid grid = test::grid_of(cloud, 0.5);
  EXPECT_EQ(grid.size(), 2u);
  EXPECT_GE(grid.find({-1, 0, -2}), 0);
  EXPECT_GE(grid.find({0, -1, -3}), 0);
  EXPECT_EQ(grid.find({0, 0, 0}), -1);
  EXPECT_EQ(grid.key_of({-0.01, 0.01, -1.0}), (VoxelKey{-1, 0, -2}));
  EXPECT_EQ(grid.center_of({-1, 0, -2}), Vec3(-0.25, 0.25, -0.75));
}

TEST(Voxels, SkippedAndNonFinitePointsAreLeftOut) {
  PointCloud cloud;
  cloud.positions = {
      {0, 0, 0}, {0.1, 0, 0}, {std::nan(""), 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
  VoxelBuilder builder(1.0);
  builder.add(cloud, {false, true, false, false});
  ASSERT_EQ(builder.keys().size(), 1u);
  EXPECT_EQ(builder.sums()[0].count, 1);
}

TEST(Voxels, TooFineAGridIsAnErrorNotAnOverflow) {
  PointCloud cloud;
  cloud.positions = {{5e6, 0, 0}};
  VoxelBuilder builder(1e-4);
  EXPECT_THROW(builder.add(cloud), InputError);
}

TEST(Voxels, CoarserConservesMoments) {
  const VoxelGrid grid = test::grid_of(sample(5000, 7), 0.05);
  std::vector<int> parent;
  const VoxelGrid coarse = grid.coarser(parent);
  EXPECT_EQ(coarse.edge, 0.1);
  ASSERT_EQ(parent.size(), grid.size());
  Moments fine_all, coarse_all;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    fine_all += grid.moments[i];
    for (int a = 0; a < 3; ++a)
      EXPECT_EQ(static_cast<int>(std::floor(grid.keys[i][a] / 2.0)), coarse.keys[parent[i]][a]);
  }
  for (const Moments& m : coarse.moments) coarse_all += m;
  EXPECT_EQ(coarse_all.count, 5000.0);
  EXPECT_LT((coarse_all.mean - fine_all.mean).norm(), 1e-12);
  EXPECT_LT((coarse_all.scatter - fine_all.scatter).norm(), 1e-9 * fine_all.scatter.norm());
  // Each coarse voxel has just what a grid built at that size has.
  const VoxelGrid built = test::grid_of(sample(5000, 7), 0.1);
  ASSERT_EQ(built.keys, coarse.keys);
  for (std::size_t i = 0; i < built.size(); ++i) {
    EXPECT_EQ(built.moments[i].count, coarse.moments[i].count);
    EXPECT_LT((built.moments[i].mean - coarse.moments[i].mean).norm(), 1e-6);
  }
}

void expect_neighbours_as_by_brute_force(const PointCloud& cloud) {
  VoxelGrid grid = test::grid_of(cloud, 0.07);
  Random random(9);
  std::vector<int> farthest_of(grid.size());
  for (int& reach : farthest_of) reach = static_cast<int>(random.index(VoxelGrid::kMostReach + 1));
  grid.find_farther(farthest_of, Context());
  for (int probe = 0; probe < 200; ++probe) {
    const std::size_t voxel = random.index(grid.size());
    const int reach = static_cast<int>(random.index(std::max(farthest_of[voxel], VoxelGrid::kFirstReach) + 1));
    const VoxelKey& key = grid.keys[voxel];
    std::vector<int> found;
    grid.for_neighbours(voxel, reach, [&](int i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    std::vector<int> expected;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      int farthest = 0;
      for (int a = 0; a < 3; ++a) farthest = std::max(farthest, std::abs(grid.keys[i][a] - key[a]));
      if (farthest <= reach) expected.push_back(static_cast<int>(i));
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(Voxels, NeighboursEqualBruteForce) {
  expect_neighbours_as_by_brute_force(sample(3000, 8));
  Random random(10);
  for (const double height : {2.8, 8.4}) {  // columns of 10 and of 30 blocks
    PointCloud tower;
    for (int i = 0; i < 5000; ++i) tower.positions.push_back({random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), height * random.uniform(-0.5, 0.5)});
    expect_neighbours_as_by_brute_force(tower);
  }
}

}  // namespace
}  // namespace unseen::planes
