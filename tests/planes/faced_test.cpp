// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Distances between planes that face each other.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "planes/result/describe.h"

namespace unseen::planes {
namespace {

/// A level rectangle: x, y, width, depth, height.
using Sheet = std::array<double, 5>;

/// Distances by the sheets that they lie between, with all turned about the vertical.
std::map<std::pair<int, int>, double> distances(const std::vector<Sheet>& sheets, double turn) {
  Arrangement a;
  a.scale = 0.05;
  a.directions.push_back({Vec3::UnitZ(), 0});
  const Vec3 u(std::cos(turn), std::sin(turn), 0), v(-std::sin(turn), std::cos(turn), 0);
  for (const auto& [x, y, width, depth, height] : sheets) {
    ArrangedPlane p;
    p.plane = {Vec3::UnitZ(), height};
    p.direction = p.frame = 0;
    const Vec3 c = x * u + y * v + Vec3(0, 0, height);
    p.polygon = {{c, c + width * u, c + width * u + depth * v, c + depth * v}};
    p.area = width * depth;
    a.planes.push_back(p);
  }
  find_second_order(a);
  std::map<std::pair<int, int>, double> found;
  for (const Distance& d : a.distances) found[{d.a, d.b}] = d.distance;
  return found;
}

using Expected = std::map<std::pair<int, int>, double>;

TEST(Distances, OfARoomAndOfATableThatHidesLittleOfIt) {
  for (const double turn : {0.0, 0.35, 0.8})
    EXPECT_EQ(distances({{0, 0, 5, 4, 0}, {0, 0, 5, 4, 2.5}, {2, 1, 1.4, 0.8, 0.75}}, turn), (Expected{{{0, 1}, 2.5}, {{0, 2}, 0.75}, {{1, 2}, 1.75}})) << turn;
}

TEST(Distances, AreNoneThroughAStorey) {
  EXPECT_EQ(distances({{0, 0, 5, 4, 0}, {0, 0, 5, 4, 2.5}, {0, 0, 5, 4, 2.75}, {0, 0, 5, 4, 5.25}}, 0.3), (Expected{{{0, 1}, 2.5}, {{1, 2}, 0.25}, {{2, 3}, 2.5}}));
}

TEST(Distances, AreNoneBetweenRoomsSideBySide) {
  for (const double turn : {0.0, 0.1, 0.8})
    EXPECT_EQ(distances({{0, 0, 5, 4, 0}, {0, 0, 5, 4, 2.5}, {5.125, 0, 4, 4, 0.5}, {5.125, 0, 4, 4, 3}}, turn), (Expected{{{0, 1}, 2.5}, {{2, 3}, 2.5}})) << turn;
}

TEST(Distances, AreNoneOfWhatHardlyOverlaps) {
  EXPECT_EQ(distances({{0, 0, 4, 4, 0}, {3, 0, 4, 4, 1}}, 0.0), Expected{});
  EXPECT_EQ(distances({{0, 0, 4, 4, 0}, {2, 0, 4, 4, 1}}, 0.0), (Expected{{{0, 1}, 1.0}}));
}

TEST(Distances, OfLinesOfADrawing) {
  Arrangement a;
  a.two_dimensional = true;
  a.scale = 0.05;
  a.directions.push_back({Vec3::UnitY(), 0});
  for (const auto& [from, to, at] : std::vector<std::array<double, 3>>{{0, 4, 0}, {0, 4, 3}, {1, 2, 1}, {6, 8, 2}}) {
    ArrangedPlane p;
    p.plane = {Vec3::UnitY(), at};
    p.direction = p.frame = 0;
    p.segment = {Vec3(from, at, 0), Vec3(to, at, 0)};
    p.area = to - from;
    a.planes.push_back(p);
  }
  find_second_order(a);
  Expected found;
  for (const Distance& d : a.distances) found[{d.a, d.b}] = d.distance;
  EXPECT_EQ(found, (Expected{{{0, 1}, 3.0}, {{0, 2}, 1.0}, {{1, 2}, 2.0}}));
}

}  // namespace
}  // namespace unseen::planes
