// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "unseen/core/quantile.h"

namespace unseen {
namespace {

/// By definition: a point is a corner if some side of the hull starts there, that is if all other points lie left of a line through it and another.
std::vector<Vec2> corners_by_brute_force(const std::vector<Vec2>& points) {
  std::vector<Vec2> corners;
  for (const Vec2& a : points)
    if (std::any_of(points.begin(), points.end(), [&](const Vec2& b) {
          return a != b && std::all_of(points.begin(), points.end(), [&](const Vec2& c) { return c == a || c == b || turn(a, b, c) > 0; });
        }))
      corners.push_back(a);
  return corners;
}

TEST(Convex, TheHullHasTheCornersThatEveryLineLeavesOnOneSide) {
  std::mt19937 random(7);
  std::normal_distribution<double> place;
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> points(40);
    for (Vec2& p : points) p = {place(random), place(random)};
    const std::vector<Vec2> hull = convex_hull(points), corners = corners_by_brute_force(points);
    EXPECT_EQ(hull.size(), corners.size());
    for (const Vec2& corner : corners) EXPECT_EQ(std::count(hull.begin(), hull.end(), corner), 1);
    for (std::size_t i = 0; i < hull.size(); ++i) EXPECT_GT(turn(hull[i], hull[(i + 1) % hull.size()], hull[(i + 2) % hull.size()]), 0.0);
    for (const Vec2& p : points) EXPECT_TRUE(inside_convex(hull, p, 1e-12));
    EXPECT_FALSE(inside_convex(hull, Vec2(100.0, 0.0)));
  }
}

TEST(Convex, NoCornerLiesOnASideNorTwice) {
  EXPECT_EQ(convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {1, 1}}), (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1e-15}, {2, 0}, {1, 1}}, 1e-14).size(), 3u);
}

TEST(Convex, OfALineTheEndsAreLeftAndOfAPointItself) {
  EXPECT_EQ(convex_hull({{1, 1}, {0, 0}, {3, 3}, {2, 2}}), (std::vector<Vec2>{{0, 0}, {3, 3}}));
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}, {1, 1}}), (std::vector<Vec2>{{1, 1}}));
  EXPECT_TRUE(convex_hull({}).empty());
}

TEST(Convex, TheMarginIsADistance) {
  const std::vector<Vec2> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_TRUE(inside_convex(square, {5, -0.9}, 1.0));
  EXPECT_FALSE(inside_convex(square, {5, -1.1}, 1.0));
  EXPECT_FALSE(inside_convex({}, Vec2::Zero()));
}

TEST(Quantile, IsTheValueThatTheShareLiesBelow) {
  std::vector<int> values(100);
  for (int i = 0; i < 100; ++i) values[static_cast<std::size_t>(i)] = (37 * i) % 100;
  EXPECT_EQ(quantile(values, 0.0), 0);
  EXPECT_EQ(quantile(values, 0.25), 24);
  EXPECT_EQ(quantile(values, 0.99), 98);
  EXPECT_EQ(median(values), 50);
  EXPECT_EQ(quantile(values, 1.0), 99);
  EXPECT_EQ(median(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector<double>{}), 0.0);
}

}  // namespace
}  // namespace unseen
