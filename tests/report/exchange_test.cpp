// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What tests/exchange cannot reach from the command line: hostile names, far drawings, nothing at all.
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "report/point_order.h"
#include "report/polygon_size.h"
#include "report/sample.h"
#include "report/surfaces.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

/// The sample drawing with both lines moved by `offset`.
planes::Arrangement moved_drawing(const Vec3& offset) {
  planes::Arrangement a = sample_drawing();
  for (planes::ArrangedPlane& plane : a.planes)
    for (Vec3& end : *plane.segment) end += offset;
  return a;
}

TEST(SmallestRectangle, IsThatOfATurnedRectangleWithPointsInside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 50; ++round) {
    const Eigen::Rotation2Dd turn(share(random) * kPi);
    const double width = 1 + share(random), height = share(random);
    Ring points;
    for (const Vec2& corner : {Vec2(0, 0), Vec2(width, 0), Vec2(width, height), Vec2(0, height)})
      points.push_back(turn * corner);
    for (int i = 0; i < 100; ++i)
      points.push_back(turn * Vec2(width * share(random), height * share(random)));
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_LT((smallest_rectangle(points) - Vec2(width, height)).norm(), 1e-12);
  }
}

TEST(SmallestRectangle, OfALineOrAPointIsFlat) {
  EXPECT_LT((smallest_rectangle({{0, 0}, {3, 4}, {1.5, 2}}) - Vec2(5, 0)).norm(), 1e-12);
  EXPECT_EQ(smallest_rectangle({{1, 2}, {1, 2}}), Vec2(0, 0));
}

TEST(PolygonSize, HolesCountApart) {
  const PolygonSize size = polygon_size(sample_room().planes[0]);
  EXPECT_NEAR(size.perimeter, 14, 1e-12);
  EXPECT_NEAR(size.width, 4, 1e-12);
  EXPECT_NEAR(size.height, 3, 1e-12);
  EXPECT_EQ(size.holes, 1u);
  EXPECT_NEAR(size.hole_area, 1, 1e-12);
  EXPECT_EQ(polygon_size({}).perimeter, 0);
}

TEST(PolygonSize, AWallIsAsHighAsItGoesUp) {
  planes::ArrangedPlane wall;
  wall.plane.normal = Vec3::UnitX();
  wall.polygon = {{{0, 0, 0}, {0, 1, 0}, {0, 1, 3}, {0, 0, 3}}};
  wall.tag = "wall";
  EXPECT_NEAR(polygon_size(wall).width, 1, 1e-12);
  EXPECT_NEAR(polygon_size(wall).height, 3, 1e-12);
  wall.tag = "sloped";
  EXPECT_NEAR(polygon_size(wall).width, 3, 1e-12);
}

TEST(PlanesCsv, QuotesWhatWouldEndAField) {
  planes::Arrangement a = sample_room();
  a.planes[1].tag = "a \"wall\", really";
  EXPECT_NE(planes_csv(a).find("\r\n1,\"a \"\"wall\"\", really\",0,1,1,0,0,2,12,"), std::string::npos);
}

TEST(SceneUsda, HostileTagsStayText) {
  planes::Arrangement a = sample_room();
  a.planes[1].tag = "\"\n} def \\";
  EXPECT_NE(planes_usda(a, {}).find("userProperties:tag = \"\\\" } def \\\\\"\n"), std::string::npos);
}

TEST(Drawing, FarOnesLoseNothing) {
  const Vec3 offset(500000.25, 5400000.75, 0);
  const planes::Arrangement a = moved_drawing(offset);
  EXPECT_NE(drawing_dxf(a).find(" 10\n500000.75\n 20\n5399999.75\n 30\n0.0\n"), std::string::npos);
  const std::string svg = drawing_svg(a);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("world x = x \\+ (\\S+), world y = (\\S+) - y")));
  const Vec2 origin(std::stod(found[1]), std::stod(found[2]));
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("id=\"plane_0\".* d=\"M(\\S+) (\\S+)L")));
  EXPECT_LT(std::abs(std::stod(found[1])), 3);
  EXPECT_NEAR(origin.x() + std::stod(found[1]), 500000.75, 1e-6);
  EXPECT_NEAR(origin.y() - std::stod(found[2]), 5399999.75, 1e-6);
}

/// The same drawing in the plane y = 0.
planes::Arrangement standing_drawing() {
  planes::Arrangement a = sample_drawing();
  const auto stand = [](Vec3& v) { v = {v.x(), -v.z(), v.y()}; };
  for (planes::Direction& d : a.directions) stand(d.normal);
  for (planes::ArrangedPlane& p : a.planes) {
    stand(p.plane.normal);
    for (Vec3& end : *p.segment) stand(end);
  }
  return a;
}

TEST(Drawing, AStandingOneIsDrawnAsItStands) {
  const planes::Arrangement lying = sample_drawing(), standing = standing_drawing();
  EXPECT_EQ(planes::flat_axis(standing), 1);
  EXPECT_EQ(std::regex_replace(drawing_svg(standing), std::regex("world z"), "world y"), drawing_svg(lying));
  EXPECT_EQ(std::regex_replace(planes_csv(standing), std::regex("_z"), "_y"), planes_csv(lying));
}

TEST(FittedPlane, OfADrawingIsALineOfIt) {
  const std::vector<Vec3> points = {{0, 2, 0}, {1, 2, 1}, {2, 2, 2}, {3, 2, 3}};
  EXPECT_LT(line_angle(fitted_plane(points, 1).normal, Vec3(1, 0, -1)), 1e-9);
}

TEST(Exchange, NothingIsAFileToo) {
  planes::Arrangement nothing;
  EXPECT_EQ(planes_csv(nothing).substr(0, 7), "id,tag,");
  EXPECT_EQ(planes_usda(nothing, {}).find("plane_"), std::string::npos);
  nothing.two_dimensional = true;
  for (const std::string& text : {drawing_svg(nothing), drawing_dxf(nothing), planes_csv(nothing)})
    for (const char* number : {"nan", "inf"}) EXPECT_EQ(text.find(number), std::string::npos) << text;
}

TEST(OffsetOf, IsOnlyForFarScenes) {
  EXPECT_EQ(offset_of(surfaces_of(sample_room({3, 4, 5})), {}), Vec3::Zero());
  const Vec3 far(500000.25, 5400000.75, 321.5);
  EXPECT_LT((offset_of(surfaces_of(sample_room(far)), {}) - far).norm(), 5);
}

}  // namespace
}  // namespace unseen::report
