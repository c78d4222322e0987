// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Drawings in pixels whose lines are dashed.
#include <gtest/gtest.h>

#include <set>

#include "planes/scan/dashes.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// Pixels of a rectangle around this middle, turned by `yaw` (deg), two pixels wide, drawn by `dash` pixels and not by `gap`.
std::set<std::pair<int, int>> rectangle(const Vec3& middle, double length, double width, double yaw, int dash, int gap) {
  const Vec3 a = Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()) * (0.5 * length * Vec3::UnitX()), b = Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()) * (0.5 * width * Vec3::UnitY());
  std::set<std::pair<int, int>> pixels;
  const Vec3 corners[] = {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
  for (int k = 0; k < 4; ++k) {
    const Vec3 way = corners[(k + 1) % 4] - corners[k], along = way.normalized(), across(-along.y(), along.x(), 0);
    for (int t = 0; t < way.norm(); ++t)
      for (const double w : {-0.5, 0.5})
        if (const Vec3 p = corners[k] + t * along + w * across; t % (dash + gap) < dash) pixels.emplace(std::lround(p.x()), std::lround(p.y()));
  }
  return pixels;
}

PointCloud cloud_of(const std::set<std::pair<int, int>>& pixels) {
  PointCloud cloud;
  for (const auto& [x, y] : pixels) cloud.positions.emplace_back(x, y, 0);
  return cloud;
}

/// One rectangle within another that is turned by so much.
PointCloud two_rectangles(double yaw, int dash, int gap) {
  auto pixels = rectangle({310, 260, 0}, 500, 400, 0, dash, gap);
  pixels.merge(rectangle({300, 250, 0}, 220, 160, yaw, dash, gap));
  return cloud_of(pixels);
}

double gap_in(const PointCloud& cloud) {
  CloudSource source(cloud);
  Context context;
  const Survey seen = survey(source, context);
  return gap_of_dashes(seen, space_of(seen, true), 1.0, 15.0);
}

double pixel_in(const PointCloud& cloud) {
  CloudSource source(cloud);
  Context context;
  const Survey seen = survey(source, context);
  return pixel_of(seen, space_of(seen, true), rounding_of(seen));
}

TEST(Pixels, AreNoScansWhoseCoordinatesAreRounded) {
  EXPECT_EQ(pixel_in(two_rectangles(4, 1000, 1)), 1.0);
  PointCloud scan;  // of two walls, in millimetres
  Random random(2);
  for (int i = 0; i < 4000; ++i) {
    const double along = random.uniform(0, 8), across = 0.01 * random.normal();
    const Vec3 p = i % 2 == 0 ? Vec3(along, across, 0) : Vec3(across, along, 0);
    scan.positions.push_back((p * 1000.0).array().round() / 1000.0);
  }
  EXPECT_EQ(pixel_in(scan), 0.0);
}

TEST(Dashes, TheirGapIsThatDrawn) {
  for (const auto& [dash, gap] : {std::pair(9, 5), {12, 8}, {20, 10}}) EXPECT_NEAR(gap_in(two_rectangles(4, dash, gap)), gap + 1, 1.6) << dash;  // between middles of pixels
}

TEST(Dashes, AreNoneOfLinesDrawnThroughNorOfScatteredStrokes) {
  EXPECT_EQ(gap_in(two_rectangles(4, 1000, 1)), 0.0);
  Random random(1);
  std::set<std::pair<int, int>> strokes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from(random.uniform(0, 600), random.uniform(0, 500), 0), way = Eigen::AngleAxisd(random.uniform(0, kPi), Vec3::UnitZ()) * Vec3::UnitX();
    for (int t = 0; t < 10; ++t) strokes.emplace(std::lround((from + t * way).x()), std::lround((from + t * way).y()));
  }
  EXPECT_EQ(gap_in(cloud_of(strokes)), 0.0);
}

TEST(Dashes, OfATurnedRectangleKeepItsTurn) {
  const test::Run r = test::run(two_rectangles(4, 9, 5), Options());
  EXPECT_EQ(r.result.planes.size(), 8u);
  EXPECT_EQ(r.result.frames.size(), 2u);
  const auto& warnings = r.result.summary.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("dashed") != std::string::npos; }));
}

}  // namespace
}  // namespace unseen::planes
