// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Floors that fall to a gully from all sides.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "planes/patches/facets.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// Points of a square of this width, at heights by place.
PointCloud square(double width, double spacing, double noise, const std::function<double(double, double)>& height) {
  PointCloud cloud;
  Random random(1);
  for (double x = 0; x < width; x += spacing)
    for (double y = 0; y < width; y += spacing) cloud.positions.push_back({x, y, height(x, y) + noise * random.normal()});
  return cloud;
}

/// How high a pan of this width lies above its gully, in the middle.
double pan(double x, double y, double width, double fall) {
  return fall * std::max(std::abs(x - 0.5 * width), std::abs(y - 0.5 * width));
}

Facets facets_of(const PointCloud& cloud, std::size_t* voxels = nullptr) {
  const VoxelGrid grid = test::grid_of(cloud, 0.06);
  if (voxels != nullptr) *voxels = grid.size();
  std::vector<int> all(grid.size());
  std::iota(all.begin(), all.end(), 0);
  const Moments whole = sum_of(grid, all);
  return facets_in(grid, all, whole, fit_plane(whole, {}));
}

TEST(Facets, AreThoseOfADrainedFloor) {
  std::size_t voxels = 0;
  const Facets facets = facets_of(square(6.0, 0.04, 0.003, [](double x, double y) { return pan(x, y, 6.0, 0.02); }), &voxels);
  ASSERT_EQ(facets.pieces.size(), 4u);
  std::size_t cells = 0;
  for (const std::vector<int>& piece : facets.pieces) {
    EXPECT_TRUE(std::is_sorted(piece.begin(), piece.end()));
    cells += piece.size();
  }
  EXPECT_EQ(cells, voxels);
}

TEST(Facets, AreNoneOfWhatIsFlatOrSags) {
  EXPECT_TRUE(facets_of(square(6.0, 0.04, 0.003, [](double, double) { return 0.0; })).pieces.empty());
  EXPECT_TRUE(facets_of(square(6.0, 0.04, 0.02, [](double, double) { return 0.0; })).pieces.empty());
  for (const double sag : {0.02, 0.06, 0.2})
    EXPECT_TRUE(facets_of(square(6.0, 0.04, 0.003, [&](double x, double y) { return sag * (std::pow(x / 3 - 1, 2) + std::pow(y / 3 - 1, 2)); })).pieces.empty()) << sag;
  EXPECT_TRUE(facets_of(square(6.0, 0.04, 0.003, [](double x, double y) { return 0.02 * std::sin(2 * x) * std::cos(1.7 * y); })).pieces.empty());  // bumps
  EXPECT_TRUE(facets_of(square(6.0, 0.04, 0.003, [](double x, double y) { return pan(x, y, 6.0, 0.005); })).pieces.empty());                     // too flat
}

// A deck of six pans of 2.5 m beside walls: each facet is its own, and none of them is level.
TEST(Facets, OfADeckKeepTheirFall) {
  constexpr double kWidth = 2.5;
  PointCloud cloud;
  Random random(3);
  const auto fold = [](double x) { return x - kWidth * std::floor(x / kWidth); };
  for (double x = 0; x < 3 * kWidth; x += 0.04)
    for (double y = 0; y < 2 * kWidth; y += 0.04) cloud.positions.push_back({x, y, pan(fold(x), fold(y), kWidth, 0.02) + 0.002 * random.normal()});
  const std::size_t deck = cloud.size();
  test::add_rectangle(cloud, {-0.05, 0, 0.1}, {0, 2 * kWidth, 0}, {0, 0, 2}, 0.04, 0.002, random);
  test::add_rectangle(cloud, {0, -0.05, 0.1}, {3 * kWidth, 0, 0}, {0, 0, 2}, 0.04, 0.002, random);
  const test::Run r = test::run(cloud, test::with_scale(0.12));
  std::size_t right = 0;
  for (std::size_t i = 0; i < deck; ++i) {
    const double u = fold(cloud.positions[i].x()) - 0.5 * kWidth, v = fold(cloud.positions[i].y()) - 0.5 * kWidth;
    const Vec3 normal = Vec3(std::abs(u) > std::abs(v) ? -std::copysign(0.02, u) : 0.0, std::abs(u) > std::abs(v) ? 0.0 : -std::copysign(0.02, v), 1.0).normalized();
    right += r.plane_of_point[i] >= 0 && line_angle(r.result.planes[r.plane_of_point[i]].plane.normal, normal) < radians(0.1);
  }
  EXPECT_GT(static_cast<double>(right), 0.75 * static_cast<double>(deck));
}

}  // namespace
}  // namespace unseen::planes
