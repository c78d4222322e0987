// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/cells.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

Cells cells_of(VoxelGrid grid, const Space& space = {}, int threads = 2) {
  Context context;
  context.threads = threads;
  return estimate_normals(grid, space, context);
}

/// Share of voxels that have a normal, and the median and largest deviation (deg) of those from the truth.
struct Quality {
  double share = 0, median = 0, largest = 0;
};
template <class Truth>
Quality quality(const VoxelGrid& grid, const Cells& cells, Truth truth) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (!cells.normal[i].isZero()) {
      EXPECT_NEAR(cells.normal[i].norm(), 1.0, 1e-9);
      errors.push_back(degrees(line_angle(cells.normal[i], truth(grid.moments[i].mean))));
    }
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  return {static_cast<double>(errors.size()) / grid.size(), errors[errors.size() / 2], errors.back()};
}

TEST(Cells, NormalsOfANoisyPlane) {
  PointCloud cloud;
  Random random(1);
  const Vec3 a(2, 0.3, 0.5), b(-0.2, 2, 0.1);
  test::add_rectangle(cloud, {0, 0, 0}, a, b, 0.02, 0.005, random);
  const VoxelGrid grid = test::grid_of(cloud, 0.05);  // ρ = 0.1
  const Vec3 n = a.cross(b).normalized();
  const Quality q = quality(grid, cells_of(grid), [&](const Vec3&) { return n; });
  EXPECT_GT(q.share, 0.98);
  EXPECT_LT(q.median, 1.5);
  EXPECT_LT(q.largest, 10.0);
}

TEST(Cells, NormalsOfASphere) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 40'000; ++i)
    cloud.positions.push_back(Vec3(5, 5, 5) + (1 + 0.003 * random.normal()) * random.direction());
  const VoxelGrid grid = test::grid_of(cloud, 0.05);
  const Quality q =
      quality(grid, cells_of(grid), [](const Vec3& p) { return Vec3((p - Vec3(5, 5, 5)).normalized()); });
  EXPECT_GT(q.share, 0.98);
  EXPECT_LT(q.median, 1.5);
  EXPECT_LT(q.largest, 8.0);
}

/// Two faces that meet in a crisp edge. What has a flat neighbourhood has the normal of one of them; what a
/// normal over the edge averages is not flat, and proves nothing.
TEST(Cells, ACrispEdgeProvesNothingWrong) {
  PointCloud cloud;
  Random random(3);
  test::add_rectangle(cloud, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.01, 0.0, random);
  test::add_rectangle(cloud, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.01, 0.0, random);
  const VoxelGrid grid = test::grid_of(cloud, 0.04);
  const Cells cells = cells_of(grid);
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Vec3& p = grid.moments[i].mean;
    const bool floor = p.z() < 1e-3, wall = p.x() < 1e-3;
    if (floor && p.x() > 0.2) {
      EXPECT_LT(line_angle(cells.normal[i], Vec3::UnitZ()), radians(0.1));
      agreeing += compare_normal(cells, i, Vec3::UnitZ()) == NormalVerdict::agrees;
      EXPECT_EQ(compare_normal(cells, i, Vec3::UnitX()), NormalVerdict::contradicts);
    }
    if (wall && p.z() > 0.2) {
      EXPECT_LT(line_angle(cells.normal[i], Vec3::UnitX()), radians(0.1));
    }
    if (p.x() > 0.08 || p.z() > 0.08) continue;
    // Within ρ of the edge neither face may be ruled out for its own points.
    if (floor) {
      EXPECT_NE(compare_normal(cells, i, Vec3::UnitZ()), NormalVerdict::contradicts);
    }
    if (wall) {
      EXPECT_NE(compare_normal(cells, i, Vec3::UnitX()), NormalVerdict::contradicts);
    }
  }
  EXPECT_GT(agreeing, 300u);
}

/// A wire along x: round, so that its points do not tell a normal.
PointCloud wire(double radius, const Vec3f& normal) {
  PointCloud cloud;
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(0, 2 * kPi);
    cloud.positions.emplace_back(0.005 * i, radius * std::cos(a), radius * std::sin(a));
    cloud.normals.push_back(normal);
  }
  return cloud;
}

TEST(Cells, AWireHasNoNormalButTheInputsOwn) {
  VoxelGrid grid = test::grid_of(wire(0.01, {0, 0.6f, 0.8f}), 0.05);
  const Cells with = cells_of(grid);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_LT(line_angle(with.normal[i], Vec3(0, 0.6, 0.8)), 1e-3);
    // Only a flat neighbourhood proves anything; a point's normal is noisy.
    EXPECT_EQ(compare_normal(with, i, Vec3::UnitX()), NormalVerdict::unknown);
  }
  grid.normals.clear();
  const Cells without = cells_of(grid);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_TRUE(without.normal[i].isZero());
    EXPECT_EQ(compare_normal(without, i, Vec3::UnitX()), NormalVerdict::unknown);
  }
}

/// Points exactly on a line lie in every plane through it: none of these may be taken for their normal.
TEST(Cells, AnExactLineHasNoNormal) {
  VoxelGrid grid = test::grid_of(wire(0.0, {0, 0, 1}), 0.05);
  grid.normals.clear();
  for (const Vec3& n : cells_of(grid).normal) EXPECT_TRUE(n.isZero());
}

/// Zero normals in the input are none at all: not a direction that all points share.
TEST(Cells, ZeroInputNormalsCountAsNone) {
  const VoxelGrid grid = test::grid_of(wire(0.01, {0, 0, 0}), 0.05);
  EXPECT_TRUE(grid.normals.empty());
  for (const Vec3& n : cells_of(grid).normal) EXPECT_TRUE(n.isZero());
}

TEST(Cells, LinesOfADrawing) {
  PointCloud cloud;
  Random random(4);
  const Vec3 along = Vec3(1, 0.7, 0).normalized(), across(-along.y(), along.x(), 0);
  for (int i = 0; i < 600; ++i)
    cloud.positions.push_back(0.005 * i * along + 0.003 * random.normal() * across);
  Space space;
  space.flat_axis = Vec3::UnitZ();
  const VoxelGrid grid = test::grid_of(cloud, 0.04);
  const Quality q = quality(grid, cells_of(grid, space), [&](const Vec3&) { return across; });
  EXPECT_EQ(q.share, 1.0);
  EXPECT_LT(q.median, 2.0);
  EXPECT_LT(q.largest, 8.0);
  for (const Vec3& n : cells_of(grid, space).normal) EXPECT_EQ(n.z(), 0.0);
}

TEST(Cells, ThreadsDoNotMatter) {
  const VoxelGrid grid = test::grid_of(test::box_cloud({0, 0, 0}, {2, 1.5, 1}, 0.01, 0.002, 5), 0.025);
  ASSERT_GT(grid.size(), 2u * 4096u);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  const Cells one = cells_of(grid, {}, 1), four = cells_of(grid, {}, 4);
  EXPECT_TRUE(one.normal == four.normal);
  EXPECT_EQ(one.variation, four.variation);
}

TEST(AdaptTolerance, GrowsWithTheDistanceToTheViewpoint) {
  PointCloud cloud;
  Random random(6);
  test::add_rectangle(cloud, {0, 0, 0}, {10, 0, 0}, {0, 1, 0}, 0.02, 0.0, random);
  const VoxelGrid grid = test::grid_of(cloud, 0.05);
  Cells cells = cells_of(grid);
  const Vec3 viewpoint(0, 0.5, 0.2);
  for (const double t : cells.tolerance) EXPECT_EQ(t, 0.1);
  adapt_tolerance(cells, grid, viewpoint);
  std::vector<double> distance;
  for (const Moments& m : grid.moments) distance.push_back((m.mean - viewpoint).norm());
  std::nth_element(distance.begin(), distance.begin() + distance.size() / 2, distance.end());
  const double median = distance[distance.size() / 2];
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double expected = 0.1 * std::clamp((grid.moments[i].mean - viewpoint).norm() / median, 1.0, 4.0);
    EXPECT_NEAR(cells.tolerance[i], expected, 1e-12);
  }
}

/// Where all is equally far, the option changes nothing.
TEST(AdaptTolerance, StartsFromWhatTheSurveyFound) {
  VoxelGrid grid = test::grid_of(test::plane_cloud(0.02, 0.0), 0.05);
  grid.tolerance = 0.03;
  Cells cells = cells_of(grid);
  adapt_tolerance(cells, grid, Vec3(0, 0, 1e6));
  for (const double t : cells.tolerance) EXPECT_NEAR(t, 0.03, 1e-6);
}

/// A far wall whose noise is above the scale, but not above what the option allows there.
TEST(AdaptTolerance, FarPlanesStay) {
  PointCloud cloud;
  Random random(8);
  test::add_rectangle(cloud, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, 0.005, 0.001, random);
  test::add_rectangle(cloud, {-1, -1, 5}, {2, 0, 0}, {0, 2, 0}, 0.0125, 0.025, random);
  Options options = test::with_scale(0.02);
  options.adaptive_scale = true;
  options.viewpoint = {0, 0, 0};
  const Arrangement a = test::run(cloud, options).result;
  ASSERT_EQ(a.planes.size(), 2u);
  EXPECT_GT(a.summary.counts[1].second, 0.9 * static_cast<double>(cloud.size()));  // assigned
}

TEST(AdaptTolerance, GrowsWithTheNoiseButNotBeyondFourTimes) {
  PointCloud cloud;
  Random random(7);
  test::add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.01, 0.001, random);
  test::add_rectangle(cloud, {3, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.01, 0.003, random);
  test::add_rectangle(cloud, {5, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, 0.01, 0.012, random);
  const VoxelGrid grid = test::grid_of(cloud, 0.1);
  Cells cells = cells_of(grid);
  adapt_tolerance(cells, grid, std::nullopt);
  const auto mean_between = [&](double low, double high) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (const double x = grid.moments[i].mean.x(); x > low && x < high && grid.moments[i].count > 30)
        sum += cells.tolerance[i], ++count;
    return sum / count;
  };
  EXPECT_LT(mean_between(0, 2), 0.2 * 1.2);
  EXPECT_GT(mean_between(3, 4), 0.2 * 1.8);
  EXPECT_LE(*std::max_element(cells.tolerance.begin(), cells.tolerance.end()), 0.8 + 1e-12);
}

}  // namespace
}  // namespace unseen::planes
