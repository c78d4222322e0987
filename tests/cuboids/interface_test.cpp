// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Where solids meet, against sampling and alternating projections.
#include "cuboids/statics/interface.h"

#include <gtest/gtest.h>

#include "cuboids/stacks.h"
#include "unseen/core/random.h"

namespace unseen::cuboids {
namespace {

Mat3 turned_about(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

Vec3 nearest(const OrientedBox& box, const Vec3& p) {
  const Vec3 local = box.axes.transpose() * (p - box.center);
  return box.center + box.axes * local.cwiseMax(-box.half_size).cwiseMin(box.half_size);
}

/// Distance of two boxes by alternating projections.
double distance(const OrientedBox& a, const OrientedBox& b) {
  Vec3 p = a.center, q = p;
  for (int i = 0; i < 2000; ++i) {
    q = nearest(b, p);
    p = nearest(a, q);
  }
  return (p - q).norm();
}

double area(const std::vector<Vec3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return 0.5 * sum.norm();
}

const OrientedBox kBase = {{0, 0, 0.05}, Mat3::Identity(), {0.1, 0.12, 0.05}};

TEST(Interface, CommonFaceHasTheSampledArea) {
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3 half(random.uniform(0.03, 0.15), random.uniform(0.03, 0.15), 0.04);
    OrientedBox top{{random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), 0.14},
                    turned_about(Vec3::UnitZ(), random.uniform(0, kPi)), half};
    constexpr int kSamples = 200;
    int inside = 0;
    for (int i = 0; i < kSamples; ++i)
      for (int k = 0; k < kSamples; ++k) {
        const Vec3 p(0.1 * (2 * i + 1.0 - kSamples) / kSamples, 0.12 * (2 * k + 1.0 - kSamples) / kSamples, 0.14);
        inside += top.contains(p);
      }
    const double sampled = 0.2 * 0.24 * inside / (kSamples * kSamples);
    const Mat3 world = turned_about(random.direction(), random.uniform(0, kPi));
    const auto placed = [&](const OrientedBox& b) { return solid_of(OrientedBox{world * b.center, world * b.axes, b.half_size}); };
    const auto met = interface_of(placed(kBase), placed(top), 1e-6);
    if (sampled < 1e-4) continue;
    ASSERT_TRUE(met) << trial;
    EXPECT_NEAR(area(met->points), sampled, 4e-4) << trial;
    EXPECT_LT((met->normal - world.col(2)).norm(), 1e-9);
    EXPECT_NEAR(met->gap, 0.0, 1e-12);
    const auto mirrored = interface_of(placed(top), placed(kBase), 1e-6);
    ASSERT_TRUE(mirrored);
    EXPECT_LT((mirrored->normal + world.col(2)).norm(), 1e-9);
    EXPECT_NEAR(area(mirrored->points), area(met->points), 1e-9);
  }
}

TEST(Interface, NothingBeyondTheTolerance) {
  Random random(5);
  int near = 0, far = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const OrientedBox other{Vec3(0, 0, 0.05) + random.uniform(0.1, 0.3) * random.direction(),
                            turned_about(random.direction(), random.uniform(0, kPi)),
                            {random.uniform(0.02, 0.1), random.uniform(0.02, 0.1), random.uniform(0.02, 0.1)}};
    const double apart = distance(kBase, other), tolerance = 0.01;
    const auto met = interface_of(solid_of(kBase), solid_of(other), tolerance);
    if (apart > 1.001 * tolerance) {
      EXPECT_FALSE(met);
      ++far;
    } else if (met && met->gap > 0.0) {
      EXPECT_LE(met->gap, tolerance);
      EXPECT_GE(met->gap, apart - 1e-6);  // it joins points of both
      for (const Vec3& p : met->points) EXPECT_LT((nearest(kBase, p) - p).norm(), 2.0 * tolerance);
      ++near;
    }
  }
  EXPECT_GT(near, 5);
  EXPECT_GT(far, 50);
}

TEST(Interface, PointsOfExactStacksLieOnBothBoxes) {
  int points = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto boxes = test::random_stack(seed).scene.boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = i + 1; k < boxes.size(); ++k) {
        const OrientedBox &a = boxes[i].box, &b = boxes[k].box;
        const auto met = interface_of(solid_of(a), solid_of(b), 1e-6);
        if (!met) continue;
        ASSERT_LE(met->points.size(), 8u);
        for (const Vec3& p : met->points) {
          EXPECT_LT((nearest(a, p) - p).norm(), 2e-6);
          EXPECT_LT((nearest(b, p) - p).norm(), 2e-6);
          ++points;
        }
      }
  }
  EXPECT_GT(points, 500);
}

TEST(Interface, EdgesAndCorners) {
  const ConvexSolid base = solid_of(kBase);
  for (const double degree : {1.0, 15.0, 30.0, 45.0}) {  // a box on its edge
    const double t = radians(degree);
    const Vec3 half(0.08, 0.06, 0.04);
    const OrientedBox top{{0, 0, 0.1 + half.z() * std::cos(t) + half.x() * std::sin(t)}, turned_about(Vec3::UnitY(), t), half};
    const auto met = interface_of(base, solid_of(top), 1e-7);
    ASSERT_TRUE(met) << degree;
    ASSERT_EQ(met->points.size(), 2u) << degree;
    const double x = half.x() * std::cos(t) - half.z() * std::sin(t);
    for (const Vec3& p : met->points) EXPECT_NEAR(p.x(), x, 1e-5);
    EXPECT_NEAR((met->points[0] - met->points[1]).norm(), 0.12, 1e-6);
  }
  const Mat3 on_corner = turned_about(Vec3(1, -1, 0), std::acos(1.0 / std::sqrt(3.0)));
  const OrientedBox cube{{0.02, 0.03, 0.1 + 0.05 * std::sqrt(3.0)}, on_corner, Vec3::Constant(0.05)};
  const auto corner = interface_of(base, solid_of(cube), 1e-6);
  ASSERT_TRUE(corner);
  ASSERT_EQ(corner->points.size(), 1u);
  EXPECT_LT((corner->points[0] - Vec3(0.02, 0.03, 0.1)).norm(), 1e-6);

  const OrientedBox along_x{{0, 0, 0}, turned_about(Vec3::UnitX(), kPi / 4), {0.2, 0.05, 0.05}};
  const OrientedBox along_y{{0.03, 0.01, 0.1 * std::sqrt(2.0)}, turned_about(Vec3::UnitY(), kPi / 4), {0.05, 0.2, 0.05}};
  const auto crossed = interface_of(solid_of(along_x), solid_of(along_y), 1e-6);
  ASSERT_TRUE(crossed);
  ASSERT_EQ(crossed->points.size(), 1u);
  EXPECT_LT((crossed->points[0] - Vec3(0.03, 0, 0.05 * std::sqrt(2.0))).norm(), 1e-9);
  EXPECT_LT((crossed->normal - Vec3::UnitZ()).norm(), 1e-9);
}

TEST(Interface, MeasuredBoxesRestAsWholesThoughAskew) {
  const OrientedBox askew{{0, 0, 0.1 + 0.052}, turned_about(Vec3::UnitY(), radians(3)), {0.08, 0.06, 0.05}};
  const auto met = interface_of(solid_of(kBase), solid_of(askew), 0.008);
  ASSERT_TRUE(met);
  ASSERT_EQ(met->points.size(), 4u);
  EXPECT_GT(area(met->points), 0.9 * 0.16 * 0.12);
  const Support ground{0, SupportKind::ground, {Vec3::UnitZ(), 0.1}, {}};
  EXPECT_EQ(interface_of(ground, solid_of(askew), 0.008)->points.size(), 4u);
}

TEST(Interface, CornersOfAGridCarryNothing) {
  const auto beside_and_above = [](double x, double z) {
    return solid_of(OrientedBox{{0.2 + x, 0, 0.15 + z}, Mat3::Identity(), {0.1, 0.12, 0.05}});
  };
  EXPECT_FALSE(interface_of(solid_of(kBase), beside_and_above(0, 0), 1e-6));
  for (const double x : {-0.003, 0.0, 0.003})
    for (const double z : {-0.003, 0.0, 0.003}) EXPECT_FALSE(interface_of(solid_of(kBase), beside_and_above(x, z), 0.008));
}

TEST(Interface, SupportEndsAtItsOutline) {
  Support desk{0, SupportKind::desk, {Vec3::UnitZ(), 0.7}, {{-0.5, -0.3, 0.7}, {0.5, -0.3, 0.7}, {0.5, 0.3, 0.7}, {-0.5, 0.3, 0.7}}};
  const auto met = interface_of(desk, solid_of(OrientedBox{{0.5, 0, 0.8}, Mat3::Identity(), {0.1, 0.1, 0.1}}), 1e-6);
  ASSERT_TRUE(met);
  EXPECT_NEAR(area(met->points), 0.1 * 0.2, 1e-5);
  EXPECT_FALSE(interface_of(desk, solid_of(OrientedBox{{0.7, 0, 0.8}, Mat3::Identity(), {0.1, 0.1, 0.1}}), 1e-6));
  EXPECT_FALSE(interface_of(desk, solid_of(OrientedBox{{0, 0, 0.82}, Mat3::Identity(), {0.1, 0.1, 0.1}}), 0.01));
}

TEST(Solid, OfAMeshIsThatOfTheBox) {
  const ConvexSolid box = solid_of(kBase);
  TriangleMesh mesh;
  for (const auto& face : box.faces)  // each triangle with vertices of its own, as in an STL
    for (std::size_t i = 2; i < face.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const int v : {face[0], face[i], face[i - 1]}) mesh.vertices.push_back(box.vertices[v]);  // inside out
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  const ConvexSolid solid = solid_of(mesh);
  EXPECT_EQ(solid.vertices.size(), 8u);
  EXPECT_EQ(solid.faces.size(), 6u);
  EXPECT_EQ(solid.edges.size(), 12u);
  EXPECT_EQ(solid.edge_directions.size(), 3u);
  for (const Plane& p : solid.planes) EXPECT_LT(p.signed_distance(kBase.center), 0.0);
  mesh.triangles.pop_back();
  EXPECT_THROW(solid_of(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace unseen::cuboids
