// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <limits>

#include "planes/scenes.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

PointCloud cloud_of(std::vector<Vec3> points) {
  PointCloud cloud;
  cloud.positions = std::move(points);
  return cloud;
}

/// The message names what is wrong and what was expected.
void expect_refused(const PointCloud& cloud, const Options& options, const std::string& field) {
  try {
    test::run(cloud, options);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(field), std::string::npos) << e.what();
  }
}

TEST(BadInput, NoPoints) {
  expect_refused({}, Options(), "points");
}

TEST(BadInput, NothingFinite) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  expect_refused(cloud_of({{nan, 0, 0}, {0, inf, 0}, {0, 0, -inf}, {nan, nan, nan}}), Options(), "points");
}

TEST(BadInput, OneOrTwoPoints) {
  expect_refused(cloud_of({{1, 2, 3}}), Options(), "points");
  expect_refused(cloud_of({{1, 2, 3}, {1.5, 2, 4}}), test::with_scale(0.1), "points");
}

TEST(BadInput, AllDuplicates) {
  expect_refused(cloud_of(std::vector<Vec3>(1000, Vec3(0.1, 0.2, 0.3))), Options(), "points");
  std::vector<Vec3> two(1000, Vec3(0.1, 0.2, 0.3));
  for (std::size_t i = 0; i < two.size(); i += 2) two[i] = {0.5, 0.7, 0.9};
  expect_refused(cloud_of(two), test::with_scale(0.1), "points");
}

class Collinear : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Lines, Collinear, testing::Range(0, 4));

TEST_P(Collinear, IsRefused) {
  const Vec3 along[] = {Vec3::UnitX(), Vec3::UnitZ(), Vec3(1, 1, 0), Vec3(0.3, -0.8, 0.4)};
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i)
    cloud.positions.push_back(Vec3(0.5, 0.25, 4) + 0.001 * i * along[GetParam()]);
  if (GetParam() == 2) {
    // A slanted line in a coordinate plane is a drawing of one line, which has its answer.
    const test::Run r = test::run(cloud, test::with_scale(0.05));
    EXPECT_TRUE(r.result.two_dimensional);
    EXPECT_EQ(r.result.planes.size(), 1u);
    return;
  }
  expect_refused(cloud, test::with_scale(0.05), "points");
  expect_refused(cloud, Options(), "points");
}

PointCloud box() {
  return test::box_cloud({0, 0, 0}, {2, 1.5, 1}, 0.03, 0.002, 1);
}

TEST(BadInput, ScaleThatCannotBe) {
  for (const double scale : {2.5, 1e9, 0.0, -0.1, std::numeric_limits<double>::infinity(), std::nan("")}) {
    SCOPED_TRACE(scale);
    expect_refused(box(), test::with_scale(scale), "scale");
  }
}

TEST(BadInput, AViewpointThatIsNoPoint) {
  Options options = test::with_scale(0.08);
  options.adaptive_scale = true;
  options.viewpoint = {1, 2};
  expect_refused(box(), options, "viewpoint");
  options.adaptive_scale = false;  // where nothing asks for it, too
  expect_refused(box(), options, "viewpoint");
}

TEST(BadInput, OptionsOutsideTheirRange) {
  Options options;
  OptionTable table = describe(options);
  for (const auto& [name, value] : {std::pair{"scale", "0"},
                                    {"scale", "-1"},
                                    {"scale", "nan"},
                                    {"angles", "0"},
                                    {"angles", "90,-5"},
                                    {"angles", "200"},
                                    {"angles", ""},
                                    {"lambda", "1.5"},
                                    {"lambda", "-0.1"},
                                    {"relative_scale", "0"},
                                    {"relative_scale", "2"},
                                    {"patch_angle", "0"},
                                    {"solver", "best"},
                                    {"solver", ""},
                                    {"seed", "-1"},
                                    {"no_such", "1"}})
    EXPECT_THROW(table.set_text(name, value, "test"), InputError) << name << " = " << value;
  EXPECT_NO_THROW(table.set_text("angles", "60,90", "test"));
  EXPECT_EQ(options.angles, (std::vector<double>{60, 90}));
}

/// A few points that are not finite, twins, and stray ones do no harm.
TEST(BadInput, SomeBadPointsDoNoHarm) {
  PointCloud cloud = box();
  const test::Run clean = test::run(cloud, test::with_scale(0.08));
  for (int i = 0; i < 100; ++i) {
    cloud.positions.emplace_back(std::nan(""), i, 0);
    cloud.positions.push_back(cloud.positions[7 * i]);
  }
  const test::Run dirty = test::run(cloud, test::with_scale(0.08));
  ASSERT_EQ(dirty.result.planes.size(), clean.result.planes.size());
  ASSERT_EQ(clean.result.planes.size(), 6u);
  const std::size_t n = clean.plane_of_point.size();
  for (std::size_t p = 0; p < 6; ++p) {
    EXPECT_EQ(dirty.result.planes[p].plane.normal, clean.result.planes[p].plane.normal);
    EXPECT_EQ(dirty.result.planes[p].plane.offset, clean.result.planes[p].plane.offset);
  }
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(dirty.plane_of_point[i], clean.plane_of_point[i]);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(dirty.plane_of_point[n + 2 * i], -1);
    EXPECT_EQ(dirty.plane_of_point[n + 2 * i + 1], dirty.plane_of_point[7 * i]);  // its twin's
  }
}

class Strays : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Values, Strays,
                         testing::Values(0.0, -9999.0, -32768.0, 1e5, 1e10, 3.4028234663852886e38));

/// No-data values and a few points far away change neither the scale nor the planes; how many is said.
TEST_P(Strays, AreLeftOutWithAWarning) {
  PointCloud cloud = box();
  for (Vec3& p : cloud.positions) p += Vec3(500'000, 5'000'000, 300);
  const test::Run clean = test::run(cloud, Options());
  for (int i = 0; i < 5; ++i) cloud.positions.push_back(Vec3::Constant(GetParam()));
  cloud.positions.emplace_back(500'900, 5'000'000, 300);
  const test::Run dirty = test::run(cloud, Options());
  EXPECT_EQ(dirty.result.scale, clean.result.scale);
  ASSERT_EQ(dirty.result.planes.size(), 6u);
  ASSERT_EQ(dirty.result.summary.warnings.size(), 1u);
  EXPECT_NE(dirty.result.summary.warnings[0].find("6 of "), std::string::npos) << dirty.result.summary.warnings[0];
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_EQ(dirty.plane_of_point[i], i < clean.plane_of_point.size() ? clean.plane_of_point[i] : -1);
}

TEST(BadInput, CoordinatesWhoseDifferenceIsNoNumber) {
  expect_refused(cloud_of({{0, 0, 0}, {0, 1, 0}, {1e308, 1, 5}, {-1e308, 3, 4}, {-1e308, -1e308, 1e308}, {3, 2, 1}}),
                 Options(), "extent");
}

/// Map coordinates in single precision come in steps of half a metre: said. Small ones lose nothing.
TEST(BadInput, LostDigitsAreSaid) {
  for (const double away : {5e6, 0.0}) {
    PointCloud cloud = box();
    for (Vec3& p : cloud.positions) p = (p + Vec3::Constant(away)).cast<float>().cast<double>();
    const std::vector<std::string> warnings = test::run(cloud, test::with_scale(0.08)).result.summary.warnings;
    ASSERT_EQ(warnings.size(), away > 0.0 ? 1u : 0u);
    if (away > 0.0) {
      EXPECT_NE(warnings[0].find("single precision, in steps of 0.5 m"), std::string::npos) << warnings[0];
    }
  }
}

/// "5.0000e+06", as some programs write map coordinates: said by axis. Grids of points near the origin are nothing special.
TEST(BadInput, FewDigitsAreSaid) {
  for (const double away : {5e6, 0.0}) {
    PointCloud cloud = box();
    for (Vec3& p : cloud.positions) p = Vec3(p.x() + away, std::round(p.y() + away), p.z());
    const std::vector<std::string> warnings = test::run(cloud, test::with_scale(0.08)).result.summary.warnings;
    const bool said = std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.starts_with("y comes in steps of 1 m only"); });
    EXPECT_EQ(said, away > 0.0);
    EXPECT_FALSE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.starts_with("x comes") || w.starts_with("z comes"); }));
  }
}

/// Two of three points in the air: said, if the scale is an estimate. Points that are there many times count once.
TEST(BadInput, FewPointsOnPlanesAreSaid) {
  PointCloud cloud = box();
  for (int i = 0; i < 20000; ++i) cloud.positions.push_back(cloud.positions[0]);
  EXPECT_TRUE(test::run(cloud, Options()).result.summary.warnings.empty());
  cloud = box();
  Random random(3);
  for (std::size_t i = 0, count = 2 * cloud.size(); i < count; ++i)
    cloud.positions.emplace_back(random.uniform(3, 5), random.uniform(3, 5), random.uniform(3, 5));
  const std::vector<std::string> warnings = test::run(cloud, Options()).result.summary.warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("of the points lie on planes"), std::string::npos) << warnings[0];
  EXPECT_TRUE(test::run(cloud, test::with_scale(0.08)).result.summary.warnings.empty());
}

/// Zero normals: said, and no worse than none.
TEST(BadInput, ZeroNormalsAreEstimatedInstead) {
  PointCloud cloud = box();
  const test::Run without = test::run(cloud, test::with_scale(0.08));
  cloud.normals.assign(cloud.size(), Vec3f(Vec3f::Zero()));
  const test::Run with = test::run(cloud, test::with_scale(0.08));
  EXPECT_EQ(with.result.summary.warnings.size(), 1u);
  EXPECT_TRUE(without.result.summary.warnings.empty());
  EXPECT_EQ(with.plane_of_point, without.plane_of_point);
}

TEST(BadInput, NothingFlatIsInfeasibleNotAnError) {
  PointCloud cloud;
  Random random(3);
  for (int i = 0; i < 300; ++i)
    cloud.positions.emplace_back(random.uniform(0, 10), random.uniform(0, 10), random.uniform(0, 10));
  const test::Run r = test::run(cloud, test::with_scale(0.05));
  EXPECT_TRUE(r.result.planes.empty());
  EXPECT_EQ(r.result.summary.status, Status::infeasible);
  EXPECT_EQ(r.plane_of_point, std::vector<int>(300, -1));
}

}  // namespace
}  // namespace unseen::planes
