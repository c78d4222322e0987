// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/outline.h"

#include <gtest/gtest.h>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

constexpr double kCell = 0.05;

/// A turned plane with axes u and v, and points on it wherever `inside(s, t)` holds, every 2 cm.
struct Sheet {
  Plane plane;
  Vec3 u, v, origin;
  std::vector<Vec3> points;

  template <class Inside>
  Sheet(const Vec3& normal, double size, Inside inside) {
    plane = {normal.normalized(), 0.0};
    u = any_orthogonal(plane.normal);
    v = plane.normal.cross(u);
    origin = Vec3(40, -30, 8);
    plane.offset = plane.normal.dot(origin);
    Random random(1);
    for (double s = 0; s < size; s += 0.02)
      for (double t = 0; t < size; t += 0.02)
        if (inside(s, t)) points.push_back(origin + s * u + t * v + 0.01 * random.normal() * plane.normal);
  }
  Vec2 flat(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
};

double signed_area(const Sheet& sheet, const std::vector<Vec3>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = sheet.flat(ring[i]), b = sheet.flat(ring[(i + 1) % ring.size()]);
    sum += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  return sum;
}

bool in_box(double s, double t, double s0, double t0, double s1, double t1) {
  return s >= s0 && s <= s1 && t >= t0 && t <= t1;
}

class Outlines : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Normals, Outlines, testing::Range(0, 4));

TEST_P(Outlines, RectangleWithARectangularHole) {
  const Vec3 normal[] = {Vec3::UnitZ(), -Vec3::UnitX(), Vec3(1, 2, 3), Vec3(-3, 1, -0.5)};
  const Sheet sheet(normal[GetParam()], 3, [](double s, double t) {
    return in_box(s, t, 0, 0, 3, 2) && !in_box(s, t, 1, 0.6, 2, 1.4);
  });
  const Polygon polygon = outline(sheet.points, sheet.plane, sheet.u, kCell);
  ASSERT_EQ(polygon.size(), 2u);
  EXPECT_GT(signed_area(sheet, polygon[0]), 0.0);  // counter-clockwise from the tip of the normal
  EXPECT_LT(signed_area(sheet, polygon[1]), 0.0);
  // Half a cell on each side of every edge.
  EXPECT_NEAR(signed_area(sheet, polygon[0]), 6.0, kCell * 10.0);
  EXPECT_NEAR(signed_area(sheet, polygon[1]), -0.8, kCell * 3.6);
  EXPECT_NEAR(area_of(polygon, sheet.plane.normal),
              signed_area(sheet, polygon[0]) + signed_area(sheet, polygon[1]), 1e-9);
  EXPECT_EQ(polygon[0].size(), 4u);
  EXPECT_EQ(polygon[1].size(), 4u);
  for (const auto& ring : polygon)
    for (const Vec3& p : ring) EXPECT_NEAR(sheet.plane.signed_distance(p), 0.0, 1e-9);
  for (const Vec2& corner : {Vec2(0, 0), Vec2(3, 0), Vec2(3, 2), Vec2(0, 2)}) {
    double least = 1e9;
    for (const Vec3& p : polygon[0]) least = std::min(least, (sheet.flat(p) - corner).norm());
    EXPECT_LT(least, 2 * kCell);
  }
}

TEST(Outline, LShapeHasSixCorners) {
  const Sheet sheet(Vec3(0, 1, 4), 2, [](double s, double t) { return !in_box(s, t, 1, 1, 2, 2); });
  const Polygon polygon = outline(sheet.points, sheet.plane, sheet.u, kCell);
  ASSERT_EQ(polygon.size(), 1u);
  EXPECT_EQ(polygon[0].size(), 6u);
  EXPECT_NEAR(area_of(polygon, sheet.plane.normal), 3.0, kCell * 8);
}

TEST(Outline, SmallGapsCloseAndLargeOnesCut) {
  const auto strip = [](double gap) {
    return Sheet(Vec3::UnitZ(), 3, [gap](double s, double t) { return t <= 1 && (s < 2 || s > 2 + gap); });
  };
  const Sheet narrow = strip(0.12), wide = strip(0.8);
  EXPECT_NEAR(area_of(outline(narrow.points, narrow.plane, narrow.u, kCell), Vec3::UnitZ()), 3.0, 0.4);
  const Polygon polygon = outline(wide.points, wide.plane, wide.u, 0.02);
  ASSERT_EQ(polygon.size(), 1u);
  EXPECT_NEAR(area_of(polygon, Vec3::UnitZ()), 2.0, 0.2);  // the largest part
}

/// A floor that a scanner at one end sees ever thinner: it has no holes, and a hatch in its sparse half is one.
TEST(Outline, GapsAreAsWideAsPointsAreApart) {
  for (const bool hatch : {false, true}) {
    Random random(1);
    std::vector<Vec3> points;
    while (points.size() < 24000) {
      const Vec3 p(8.0 * std::pow(random.uniform(), 3), 4.0 * random.uniform(), 0);  // 40 points/m² at the far end: 8 cells apart
      if (!hatch || p.x() < 5.0 || p.x() > 6.5 || p.y() < 1.0 || p.y() > 3.0) points.push_back(p);
    }
    const Polygon polygon = outline(points, Plane(), Vec3::UnitX(), 0.02);
    EXPECT_NEAR(area_of(polygon, Vec3::UnitZ()), hatch ? 29.0 : 32.0, 0.9);
    EXPECT_LE(polygon.size(), hatch ? 4u : 3u);
  }
}

TEST(Outline, NoPointsNoOutline) {
  EXPECT_TRUE(outline({}, Plane(), Vec3::UnitX(), kCell).empty());
}

/// What is a single cell wide still has an outline.
TEST(Outline, AThinStripIsNotLost) {
  for (const int cells : {1, 3, 40}) {
    std::vector<Vec3> points;
    for (int i = 0; i < cells; ++i) points.emplace_back((i + 0.5) * kCell, 0.5 * kCell, 0);
    const Polygon polygon = outline(points, Plane(), Vec3::UnitX(), kCell);
    ASSERT_EQ(polygon.size(), 1u) << cells << " cells";
    EXPECT_NEAR(area_of(polygon, Vec3::UnitZ()), cells * kCell * kCell,
                0.1 * cells * kCell * kCell + kCell * kCell);
  }
}

TEST(AreaOf, SubtractsHolesAndFollowsTheNormal) {
  const Polygon polygon = {{{0, 0, 5}, {4, 0, 5}, {4, 3, 5}, {0, 3, 5}},
                           {{1, 1, 5}, {1, 2, 5}, {2, 2, 5}, {2, 1, 5}}};
  EXPECT_NEAR(area_of(polygon, Vec3::UnitZ()), 11.0, 1e-12);
  EXPECT_NEAR(area_of(polygon, -Vec3::UnitZ()), -11.0, 1e-12);
  EXPECT_EQ(area_of({}, Vec3::UnitZ()), 0.0);
}

}  // namespace
}  // namespace unseen::planes
