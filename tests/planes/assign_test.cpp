// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/assign.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <map>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

constexpr double kScale = 0.1;

/// Known planes, and the voxels that support each.
struct Scene {
  PointCloud cloud;
  std::vector<Plane> planes;
  std::vector<int> truth;  ///< plane of each point
  VoxelGrid grid;
  Cells cells;
  Model model;
  Context context;

  void add(const Vec3& origin, const Vec3& a, const Vec3& b, double noise, Random& random) {
    test::add_rectangle(cloud, origin, a, b, 0.02, noise, random);
    const Vec3 n = a.cross(b).normalized();
    planes.push_back({n, n.dot(origin)});
    truth.resize(cloud.size(), static_cast<int>(planes.size()) - 1);
  }
  /// Voxels support the plane that most of their points were made on.
  void build() {
    context.threads = 2;
    grid = test::grid_of(cloud, kScale / 2);
    cells = estimate_normals(grid, {}, context);
    std::vector<std::map<int, int>> votes(grid.size());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      ++votes[grid.find(grid.key_of(cloud.positions[i]))][truth[i]];
    model.parts.resize(planes.size());
    for (std::size_t p = 0; p < planes.size(); ++p) {
      model.locals.push_back(planes[p].normal);
      Surface s;
      s.frame = 0;
      s.local = static_cast<int>(p);
      s.offset = planes[p].offset;
      model.surfaces.push_back(s);
      model.parts[p].surface = static_cast<int>(p);
    }
    model.frames = {{Mat3::Identity(), true}};
    for (std::size_t v = 0; v < grid.size(); ++v) {
      const auto most = std::max_element(votes[v].begin(), votes[v].end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      model.parts[most->first].cells.push_back(static_cast<int>(v));
      model.surfaces[most->first].support.moments += grid.moments[v];
    }
  }
  std::vector<int> assign(const PointCloud& points) const {
    const Reach reach = find_reach(model, grid, cells, false, context);
    std::vector<int> plane(points.size());
    assign_points(reach, grid, points, false, plane, context);
    return plane;
  }
};

Scene parallel_and_crossing(double noise) {
  Scene s;
  Random random(1);
  s.add({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, noise, random);
  s.add({0, 0, 0.6}, {2, 0, 0.3}, {0, 1, 0}, noise, random);
  s.add({3, 0, 0}, {0, 1, 0}, {0.2, 0, 1}, noise, random);
  s.build();
  return s;
}

/// Planes that do not meet: the nearest one within the scale that has support nearby, found by brute force.
TEST(Assign, NearestPlaneByBruteForce) {
  const Scene s = parallel_and_crossing(0.01);
  PointCloud probes;
  Random random(2);
  for (std::size_t i = 0; i < s.cloud.size(); i += 3)
    probes.positions.push_back(s.cloud.positions[i] +
                               0.04 * Vec3(random.normal(), random.normal(), random.normal()));
  const std::vector<int> plane = s.assign(probes);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Vec3& p = probes.positions[i];
    if (s.grid.find(s.grid.key_of(p)) < 0) {
      EXPECT_EQ(plane[i], -1);
      continue;
    }
    int nearest = -1;
    double least = kScale;
    for (std::size_t k = 0; k < s.planes.size(); ++k) {
      double support = 1e9;
      for (const int v : s.model.parts[k].cells)
        support = std::min(support, (s.grid.moments[v].mean - p).norm());
      if (support < kScale && std::abs(s.planes[k].signed_distance(p)) < least) {
        least = std::abs(s.planes[k].signed_distance(p));
        nearest = static_cast<int>(k);
      }
    }
    EXPECT_EQ(plane[i], nearest);
    ++checked;
  }
  EXPECT_GT(checked, 1000u);
}

TEST(Assign, WhatIsFarOrNotFiniteHasNone) {
  const Scene s = parallel_and_crossing(0.0);
  PointCloud probes;
  probes.positions = {{1, 0.5, 0.3}, {1, 5, 0}, {std::nan(""), 0, 0}, {1, 0.5, 0.001}};
  EXPECT_EQ(s.assign(probes), (std::vector<int>{-1, -1, -1, 0}));
}

/// At a convex corner each point keeps the face that it was made on, up to the noise at the very edge.
TEST(Assign, ConvexCorner) {
  Scene s;
  Random random(3);
  s.add({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 0.004, random);  // bottom
  s.add({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.004, random);  // side
  s.add({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.004, random);  // front
  s.build();
  const std::vector<int> plane = s.assign(s.cloud);
  std::size_t wrong = 0, wrong_far = 0, none = 0;
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    const Vec3& p = s.cloud.positions[i];
    const double to_edge = Vec3(p.cwiseAbs()).sum() - p.cwiseAbs().maxCoeff() - p.cwiseAbs().minCoeff();
    none += plane[i] < 0;
    wrong += plane[i] != s.truth[i];
    wrong_far += plane[i] != s.truth[i] && to_edge > 0.02;
  }
  EXPECT_EQ(none, 0u);
  EXPECT_EQ(wrong_far, 0u);
  EXPECT_LT(wrong, s.cloud.size() / 100);
}

/// A plane does not reach past the one that it ends at: points behind the wall are not the floor's.
TEST(Assign, APlaneEndsWhereItMeetsAnother) {
  Scene s;
  Random random(4);
  s.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0, random);       // floor, x > 0
  s.add({0, 0, -0.5}, {0, 1, 0}, {0, 0, 1.5}, 0.0, random);  // wall x = 0, above and below
  s.build();
  PointCloud probes;
  for (double y = 0.1; y < 0.9; y += 0.01) {
    probes.positions.emplace_back(-0.03, y, 0.001);  // behind the wall, level with the floor
    probes.positions.emplace_back(0.04, y, 0.001);   // on the floor
    probes.positions.emplace_back(0.001, y, -0.04);  // on the wall, below the floor
  }
  const std::vector<int> plane = s.assign(probes);
  std::size_t behind = 0;
  for (std::size_t i = 0; i < plane.size(); i += 3) {
    if (s.grid.find(s.grid.key_of(probes.positions[i])) >= 0) {
      EXPECT_EQ(plane[i], 1);
      ++behind;
    }
    EXPECT_EQ(plane[i + 1], 0);
    EXPECT_EQ(plane[i + 2], 1);
  }
}

TEST(Assign, ThreadsDoNotMatter) {
  Scene s = parallel_and_crossing(0.02);
  PointCloud many;
  for (int i = 0; i < 10; ++i)
    many.positions.insert(many.positions.end(), s.cloud.positions.begin(), s.cloud.positions.end());
  ASSERT_GT(many.size(), 50'000u);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  s.context.threads = 1;
  const std::vector<int> one = s.assign(many);
  s.context.threads = 4;
  EXPECT_EQ(s.assign(many), one);
}

TEST(PlaneSums, AreThePointsMomentsInAnyOrder) {
  const Scene s = parallel_and_crossing(0.01);
  PlaneSums forward(s.model, kScale);
  forward.add(s.cloud, s.truth, {});
  for (std::size_t k = 0; k < s.planes.size(); ++k) {
    Vec3 mean = Vec3::Zero();
    double n = 0;
    for (std::size_t i = 0; i < s.cloud.size(); ++i)
      if (s.truth[i] == static_cast<int>(k)) mean += s.cloud.positions[i], ++n;
    mean /= n;
    Mat3 scatter = Mat3::Zero();
    for (std::size_t i = 0; i < s.cloud.size(); ++i)
      if (s.truth[i] == static_cast<int>(k))
        scatter += (s.cloud.positions[i] - mean) * (s.cloud.positions[i] - mean).transpose();
    const Moments m = forward.moments(k);
    EXPECT_EQ(m.count, n);
    EXPECT_LT((m.mean - mean).norm(), 1e-6);
    EXPECT_LT((m.scatter - scatter).norm(), 1e-5 * scatter.norm());
  }
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto order = test::shuffled(s.cloud.size(), seed);
    const PointCloud cloud = test::reordered(s.cloud, order);
    PlaneSums other(s.model, kScale);
    for (std::size_t at = 0; at < order.size(); at += 777) {  // and in blocks
      PointCloud block;
      std::vector<int> planes;
      for (std::size_t i = at; i < std::min(order.size(), at + 777); ++i) {
        block.positions.push_back(cloud.positions[i]);
        planes.push_back(s.truth[order[i]]);
      }
      other.add(block, planes, {});
    }
    for (std::size_t k = 0; k < s.planes.size(); ++k) {
      const Moments a = forward.moments(k), b = other.moments(k);
      EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    }
  }
}

/// Of one plane: 6 m², 2 m² after a gap of 30 cm, 4 m² after another of 2.7 m, and a scrap far off.
TEST(JoinParts, WhatLiesFarOffIsAPlaneOfItsOwn) {
  Scene s;
  Random random(3);
  s.add({0, 0, 0}, {3, 0, 0}, {0, 2, 0}, 0.002, random);
  for (const auto& [x, width] : {std::pair(3.3, 1.0), {7.0, 2.0}}) test::add_rectangle(s.cloud, {x, 0, 0}, {width, 0, 0}, {0, 2, 0}, 0.02, 0.002, random);
  test::add_rectangle(s.cloud, {12, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, 0.02, 0.002, random);
  s.truth.resize(s.cloud.size(), 0);
  s.build();
  join_parts(s.model, s.grid, s.cells, s.context);
  ASSERT_EQ(s.model.parts.size(), 2u);
  EXPECT_EQ(s.model.parts[0].surface, s.model.parts[1].surface);
  const auto far_off = [&](int v) { return s.grid.moments[v].mean.x() > 6.5; };
  const std::vector<int>&main = s.model.parts[0].cells, &piece = s.model.parts[1].cells;
  EXPECT_TRUE(std::all_of(piece.begin(), piece.end(), far_off));
  EXPECT_TRUE(std::is_sorted(main.begin(), main.end()));
  EXPECT_LE(std::count_if(main.begin(), main.end(), far_off), 9);  // the scrap
  EXPECT_EQ(main.size() + piece.size(), s.grid.size());
}

TEST(DropDoubtful, WhatLiesFartherOffAPlaneThanItsNoise) {
  PointCloud cloud;
  for (const double z : {0.0, 0.05, 0.07, -0.05, -0.2, 0.4}) cloud.positions.emplace_back(0.3, 0.2, z);
  const VoxelGrid grid = test::grid_of(cloud, 0.5);
  Reach reach;
  reach.planes = {{Vec3::UnitZ(), 0.0}};
  reach.noise = {0.01};
  reach.tolerance.assign(grid.size(), 1.0);
  for (std::size_t i = 0; i <= grid.size(); ++i) reach.first.push_back(static_cast<std::uint32_t>(i));
  reach.candidate.assign(grid.size(), {0, NormalVerdict::agrees});
  std::vector<int> plane(cloud.size(), 0);
  drop_doubtful(reach, grid, cloud, plane, Context());
  EXPECT_EQ(plane, (std::vector<int>{0, 0, -1, 0, -1, -1}));
}

TEST(PlaneSums, LeavesOutWhatIsSkippedOrHasNoPlane) {
  const Scene s = parallel_and_crossing(0.01);
  PlaneSums sums(s.model, kScale);
  std::vector<bool> skip(s.cloud.size(), true);
  std::vector<int> plane = s.truth;
  for (int i = 0; i < 10; ++i) skip[i] = false;
  plane[0] = plane[1] = -1;
  sums.add(s.cloud, plane, skip);
  EXPECT_EQ(sums.moments(0).count, 8.0);
  EXPECT_EQ(sums.moments(1).count, 0.0);
}

}  // namespace
}  // namespace unseen::planes
