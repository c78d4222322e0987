// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unseen/core/random.h"

namespace unseen::report {
namespace {

Ring star(const Vec2& center, double inner, double outer, std::size_t corners, Random& random) {
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(corners);
    ring.push_back(center + random.uniform(inner, outer) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

double area_of(const std::vector<Ring>& rings) {
  double area = std::abs(doubled_area(rings[0]));
  for (std::size_t i = 1; i < rings.size(); ++i) area -= std::abs(doubled_area(rings[i]));
  return area / 2;
}

/// Sum of the triangles' areas; fails the test if one of them is not counter-clockwise.
double covered(const std::vector<Ring>& rings, const std::vector<Triangle>& triangles) {
  Ring all;
  for (const Ring& ring : rings) all.insert(all.end(), ring.begin(), ring.end());
  double area = 0;
  for (const Triangle& t : triangles) {
    const double doubled = doubled_area({all.at(t[0]), all.at(t[1]), all.at(t[2])});
    EXPECT_GT(doubled, 0);
    area += doubled / 2;
  }
  return area;
}

bool inside(const Ring& ring, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y() > p.y()) != (ring[j].y() > p.y()) &&
        p.x() <
            (ring[j].x() - ring[i].x()) * (p.y() - ring[i].y()) / (ring[j].y() - ring[i].y()) + ring[i].x())
      in = !in;
  return in;
}

TEST(Triangulate, CoversRandomPolygonsWithHolesExactly) {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Ring> rings = {star({0, 0}, 10, 14, 3 + random.index(60) * (round % 3 + 1) + 5, random)};
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        if (random.uniform() < 0.4) {
          Ring hole = star({2.0 * x, 2.0 * y}, 0.2, 0.95, 3 + random.index(12), random);
          if (random.uniform() < 0.5) std::reverse(hole.begin(), hole.end());
          rings.push_back(hole);
        }
    if (round % 2) std::reverse(rings[0].begin(), rings[0].end());
    std::size_t vertices = 0;
    for (const Ring& ring : rings) vertices += ring.size();
    const auto triangles = triangulate(rings);
    EXPECT_NEAR(covered(rings, triangles), area_of(rings), 1e-9) << "round " << round;
    EXPECT_EQ(triangles.size(), vertices + 2 * (rings.size() - 1) - 2) << "round " << round;
    Ring all;
    for (const Ring& ring : rings) all.insert(all.end(), ring.begin(), ring.end());
    for (const Triangle& t : triangles) {
      const Vec2 middle = (all[t[0]] + all[t[1]] + all[t[2]]) / 3;
      EXPECT_TRUE(inside(rings[0], middle));
      for (std::size_t h = 1; h < rings.size(); ++h) EXPECT_FALSE(inside(rings[h], middle));
    }
  }
}

TEST(Triangulate, CoversStaircasesOfAGrid) {
  // Outlines of voxels: many collinear points, holes whose sides are in line with each other and the outline.
  std::vector<Ring> rings(1);
  for (int i = 0; i < 40; ++i) rings[0].emplace_back(i, 0);
  for (int i = 0; i < 40; ++i) rings[0].emplace_back(40, i);
  for (int i = 40; i > 0; --i) {
    rings[0].emplace_back(i, 40 + i % 2);
    rings[0].emplace_back(i - 1, 40 + i % 2);
  }
  for (int i = 40; i > 0; --i) rings[0].emplace_back(0, i);
  for (int x = 2; x < 38; x += 4)
    for (int y = 2; y < 38; y += 4)
      rings.push_back({Vec2(x, y), Vec2(x, y + 1), Vec2(x, y + 2), Vec2(x + 2, y + 2), Vec2(x + 2, y)});
  EXPECT_NEAR(covered(rings, triangulate(rings)), area_of(rings), 1e-9);
}

// A hole for every few points, as the ground has under trees: some ten thousand corners.
TEST(Triangulate, CoversAPlaneOfThousandsOfHolesExactly) {
  Random random(5);
  std::vector<Ring> rings = {{{0, 0}, {60, 0}, {60, 60}, {0, 60}}};
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y) rings.push_back(star({x + 0.5, y + 0.5}, 0.1, 0.45, 3 + random.index(6), random));
  const auto triangles = triangulate(rings);
  EXPECT_NEAR(covered(rings, triangles), area_of(rings), 1e-8);
  std::size_t vertices = 0;
  for (const Ring& ring : rings) vertices += ring.size();
  EXPECT_EQ(triangles.size(), vertices + 2 * (rings.size() - 1) - 2);
}

TEST(Triangulate, HoleMayTouchTheOutlineInOnePoint) {
  const std::vector<Ring> rings = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{4, 4}, {1, 3}, {3, 1}}};
  EXPECT_NEAR(covered(rings, triangulate(rings)), area_of(rings), 1e-12);
}

TEST(Triangulate, BrokenRingsEnd) {
  Random random(3);
  for (int round = 0; round < 100; ++round) {
    std::vector<Ring> rings(1 + random.index(4));
    for (Ring& ring : rings)
      for (std::size_t i = random.index(30); i > 0; --i)
        ring.emplace_back(static_cast<double>(random.index(5)), static_cast<double>(random.index(5)));
    std::size_t vertices = 0;
    for (const Ring& ring : rings) vertices += ring.size();
    EXPECT_LE(triangulate(rings).size(), vertices + 2 * rings.size());
  }
  EXPECT_TRUE(triangulate({}).empty());
  EXPECT_TRUE(triangulate({Ring{{0, 0}, {1, 1}}}).empty());
  EXPECT_TRUE(triangulate({Ring{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}).empty());
}

/// Corners along a slanting side are in line but for rounding. A triangle of three of them would have any normal.
TEST(Triangulate, NoTriangleIsALine) {
  for (int degree = 1; degree < 360; ++degree) {
    const Eigen::Rotation2Dd turn(radians(degree));
    Ring ring;
    for (const Vec2& p : {Vec2(0, 0), Vec2(0.3, 0), Vec2(1.1, 0), Vec2(1.7, 0), Vec2(2, 0), Vec2(1, 1)}) ring.push_back(turn * p);
    const auto triangles = triangulate({ring});
    EXPECT_NEAR(covered({ring}, triangles), 1.0, 1e-6);
    for (const Triangle& t : triangles) EXPECT_GT(doubled_area({ring[t[0]], ring[t[1]], ring[t[2]]}), 1e-6) << degree;
  }
}

TEST(Triangulate, InSpaceWindingFollowsTheNormal) {
  const Vec3 normal = Vec3(1, -2, 3).normalized(), u = any_orthogonal(normal), v = normal.cross(u);
  const Vec3 origin(500000, 5400000, 300);
  planes::Polygon polygon = {{origin, origin + u, origin + u + v, origin + v}};
  for (int turned = 0; turned < 2; ++turned) {
    const auto triangles = triangulate(polygon, normal);
    ASSERT_EQ(triangles.size(), 2u);
    for (const Triangle& t : triangles) {
      const Vec3 &a = polygon[0][t[0]], &b = polygon[0][t[1]], &c = polygon[0][t[2]];
      EXPECT_NEAR((b - a).cross(c - a).dot(normal), 1.0, 1e-6);
    }
    std::reverse(polygon[0].begin(), polygon[0].end());
  }
}

}  // namespace
}  // namespace unseen::report
