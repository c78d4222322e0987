// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/frames.h"

#include <gtest/gtest.h>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

AngleSet angles_of(const std::vector<double>& generators_deg) {
  std::vector<double> g;
  for (const double a : generators_deg) g.push_back(radians(a));
  return make_angles(g);
}

Space drawing() {
  Space space;
  space.flat_axis = Vec3::UnitZ();
  return space;
}

OrientationFrame frame_of(const Mat3& axes) {
  return {axes, true};
}

Mat3 about(const Vec3& axis, double deg) {
  return Eigen::AngleAxisd(radians(deg), axis).toRotationMatrix();
}

TEST(MakeAngles, MultiplesBelow180) {
  const auto expect = [](const std::vector<double>& generators, const std::vector<double>& all, bool right) {
    const AngleSet set = angles_of(generators);
    ASSERT_EQ(set.all.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(degrees(set.all[i]), all[i], 1e-9);
    EXPECT_EQ(set.has_right_angle, right);
  };
  expect({90}, {0, 90}, true);
  expect({60}, {0, 60, 120}, false);
  expect({60, 90}, {0, 60, 90, 120}, true);
  expect({45}, {0, 45, 90, 135}, true);
  expect({45, 90}, {0, 45, 90, 135}, true);
  expect({}, {0}, false);
  expect({70}, {0, 70, 140}, false);
}

TEST(MakeAngles, DeviationIsToTheNearestAngleOfLines) {
  const AngleSet set = angles_of({60, 90});
  for (const auto& [angle, deviation] :
       {std::pair{0.0, 0.0}, {7, 7}, {50, 10}, {76, 14}, {88, 2}, {97, 7}, {125, 5}, {177, 3}, {180, 0}})
    EXPECT_NEAR(degrees(set.deviation(radians(angle))), deviation, 1e-9) << angle;
}

TEST(LocalDirections, Counts) {
  EXPECT_EQ(local_directions(angles_of({90}), {}).size(), 3u);
  EXPECT_EQ(local_directions(angles_of({90}), drawing()).size(), 2u);
  EXPECT_EQ(local_directions(angles_of({60, 90}), drawing()).size(), 6u);
  EXPECT_EQ(local_directions(angles_of({45}), drawing()).size(), 4u);
  EXPECT_EQ(local_directions(angles_of({45}), {}).size(),
            9u);  // axes, and two diagonals in each of three planes
  EXPECT_EQ(local_directions(angles_of({60}), drawing()).size(), 3u);
}

TEST(LocalDirections, AreDistinctUnitLines) {
  for (const auto& generators : {std::vector<double>{90}, {60, 90}, {45}, {30}, {60}, {36, 90}})
    for (const Space& space : {Space(), drawing()}) {
      const std::vector<Vec3> lines = local_directions(angles_of(generators), space);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_NEAR(lines[i].norm(), 1.0, 1e-12);
        if (space.is_2d()) {
          EXPECT_NEAR(lines[i].z(), 0.0, 1e-12);
        }
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(line_angle(lines[i], lines[k]), 1e-6);
      }
    }
}

/// Each direction is an axis turned about another axis by an angle of Θ: checked against a direct list.
TEST(LocalDirections, AreAxesTurnedByTheAngles) {
  const AngleSet set = angles_of({60, 90});
  std::vector<Vec3> expected;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (const double deg : {0.0, 60.0, 90.0, 120.0})
        if (a != b) {
          const Vec3 d = about(Vec3::Unit(b), deg) * Vec3::Unit(a);
          if (std::none_of(expected.begin(), expected.end(),
                           [&](const Vec3& e) { return line_angle(e, d) < 1e-6; }))
            expected.push_back(d);
        }
  const std::vector<Vec3> lines = local_directions(set, {});
  EXPECT_EQ(lines.size(), expected.size());
  for (const Vec3& e : expected)
    EXPECT_TRUE(
        std::any_of(lines.begin(), lines.end(), [&](const Vec3& l) { return line_angle(l, e) < 1e-9; }));
}

TEST(OrientationFrame, PairsOfARightAngledFrameAreExact) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 a = random.direction(), b = (any_orthogonal(a) + 0.05 * random.direction()).normalized();
    const OrientationFrame frame = close_frame(a, b, {});
    EXPECT_TRUE(frame.closed);
    EXPECT_LT(line_angle(frame.direction(Vec3::UnitX()), a), 1e-12);
    EXPECT_NEAR(frame.axes.determinant(), 1.0, 1e-12);
    EXPECT_NEAR(frame.axes.col(2).dot(b), 0.0, 1e-12);
    const std::vector<Vec3> lines = local_directions(angles_of({90}), {});
    for (std::size_t m = 0; m < lines.size(); ++m)
      for (std::size_t n = 0; n < m; ++n)
        EXPECT_NEAR(degrees(line_angle(frame.direction(lines[m]), frame.direction(lines[n]))), 90.0, 1e-12);
  }
}

TEST(OrientationFrame, OneDirectionClosesADrawingButNotASpace) {
  EXPECT_FALSE(open_frame(Vec3::UnitX(), {}).closed);
  const OrientationFrame frame = open_frame(Vec3(0.6, 0.8, 0), drawing());
  EXPECT_TRUE(frame.closed);
  EXPECT_LT(line_angle(frame.direction(Vec3::UnitY()), Vec3(-0.8, 0.6, 0)), 1e-12);
  EXPECT_LT(line_angle(frame.direction(Vec3::UnitZ()), Vec3::UnitZ()), 1e-12);
}

double f(double x) {
  return 1 - std::exp(-3 * x);
}

TEST(Irregularity, ZeroForEqualFramesInAnyRole) {
  const AngleSet set = angles_of({90});
  const std::vector<Vec3> locals = local_directions(set, {});
  const Mat3 r = about(Vec3(1, 2, 2).normalized(), 33);
  Mat3 permuted;
  permuted << r.col(1), r.col(2), r.col(0);
  EXPECT_NEAR(irregularity(frame_of(r), frame_of(r), locals, set), 0.0, 1e-9);
  EXPECT_NEAR(irregularity(frame_of(r), frame_of(permuted), locals, set), 0.0, 1e-7);
  EXPECT_NEAR(irregularity(frame_of(r), open_frame(r.col(1), {}), locals, set), 0.0, 1e-7);
}

TEST(Irregularity, IsSymmetric) {
  Random random(2);
  for (const auto& generators : {std::vector<double>{90}, {60, 90}, {60}}) {
    const AngleSet set = angles_of(generators);
    const std::vector<Vec3> locals = local_directions(set, {});
    for (int i = 0; i < 30; ++i) {
      const OrientationFrame a = close_frame(random.direction(), random.direction(), {});
      const OrientationFrame b = i % 3 == 0 ? open_frame(random.direction(), {})
                                            : close_frame(random.direction(), random.direction(), {});
      const double ab = irregularity(a, b, locals, set);
      EXPECT_NEAR(ab, irregularity(b, a, locals, set), 1e-12);
      EXPECT_GT(ab, 0.0);
      EXPECT_LT(ab, 1.0);
    }
  }
}

/// Frames that share an axis and differ by x about it: two of three directions deviate by x.
TEST(Irregularity, SharedAxisInClosedForm) {
  const AngleSet set = angles_of({90});
  const std::vector<Vec3> locals = local_directions(set, {});
  const Mat3 r = about(Vec3(3, 1, 2).normalized(), 50);
  for (const double deg : {0.5, 7.0, 30.0, 44.0, 60.0}) {
    const double x = radians(std::min(deg, 90 - deg));
    const OrientationFrame a = frame_of(r), b = frame_of(r * about(Vec3::UnitZ(), deg));
    EXPECT_NEAR(irregularity(a, b, locals, set), f(2 * x / 3), 1e-9) << deg;
    // No axis shared: dearer.
    const OrientationFrame c = frame_of(r * about(Vec3(1, 1, 1).normalized(), std::min(deg, 90 - deg)));
    EXPECT_GT(irregularity(a, c, locals, set), f(2 * x / 3));
  }
}

TEST(Irregularity, SingleDirectionsAndDrawingsInClosedForm) {
  const AngleSet right = angles_of({90});
  const std::vector<Vec3> three = local_directions(right, {});
  const auto line = [](double deg) {
    return open_frame(Vec3(std::cos(radians(deg)), std::sin(radians(deg)), 0), {});
  };
  EXPECT_NEAR(irregularity(line(0), line(20), three, right), f(radians(20)), 1e-9);
  EXPECT_NEAR(irregularity(line(0), line(87), three, right), f(radians(3)), 1e-9);
  const AngleSet six = angles_of({60, 90});
  const std::vector<Vec3> lines = local_directions(six, drawing());
  const auto flat = [](double deg) {
    return open_frame(Vec3(std::cos(radians(deg)), std::sin(radians(deg)), 0), drawing());
  };
  EXPECT_NEAR(irregularity(flat(0), flat(10), lines, six), f(radians(10)), 1e-9);  // directions every 30°
  EXPECT_NEAR(irregularity(flat(0), flat(25), lines, six), f(radians(5)), 1e-9);
}

Patch patch_with(const Vec3& n, double doubt_u, double doubt_v) {
  Patch p;
  p.fit.normal = n;
  p.fit.u = any_orthogonal(n);
  p.fit.v = n.cross(p.fit.u);
  p.doubt_u = doubt_u;
  p.doubt_v = doubt_v;
  return p;
}

TEST(DataCost, CountsStandardErrorsAlongEachAxis) {
  const Patch p = patch_with(Vec3(1, 2, 3).normalized(), 1e-4, 4e-4);
  const auto tilted = [&](double tu, double tv) {
    return Vec3((p.fit.normal + tu * p.fit.u + tv * p.fit.v).normalized());
  };
  EXPECT_NEAR(tilt_chi2(p, p.fit.normal), 0.0, 1e-12);
  EXPECT_NEAR(tilt_chi2(p, tilted(0.03, 0)), 9.0, 1e-6);
  EXPECT_NEAR(tilt_chi2(p, tilted(0, 0.03)), 2.25, 1e-6);
  EXPECT_NEAR(tilt_chi2(p, -tilted(0.01, 0.02)), 2.0, 1e-6);
  EXPECT_NEAR(data_cost(p, tilted(0.03, 0)), 1.0, 1e-6);
  EXPECT_LT(data_cost(p, tilted(0.01, 0)), 0.02);
  double last = -1;
  for (double t = 0; t < 1; t += 0.01) {
    const double cost = data_cost(p, tilted(t, 0));
    EXPECT_GT(cost, last);
    last = cost;
  }
}

TEST(BestCandidate, IsTheCheapestWithinTheAngle) {
  const AngleSet set = angles_of({60, 90});
  const std::vector<Vec3> locals = local_directions(set, {});
  Random random(3);
  int none = 0;
  for (int i = 0; i < 200; ++i) {
    const Patch p = patch_with(random.direction(), 1e-4, 3e-4);
    const OrientationFrame frame = i % 4 == 0 ? open_frame(random.direction(), {})
                                              : close_frame(random.direction(), random.direction(), {});
    Candidate expected;
    for (std::size_t l = 0; l < (frame.closed ? locals.size() : 1); ++l) {
      const Vec3 n = frame.axes * locals[l];
      if (line_angle(n, p.fit.normal) <= radians(15) && data_cost(p, n) < expected.cost)
        expected = {data_cost(p, n), static_cast<int>(l)};
    }
    const Candidate found = best_candidate(p, frame, locals, radians(15));
    EXPECT_EQ(found.local, expected.local);
    if (expected.local >= 0) {
      EXPECT_EQ(found.cost, expected.cost);
    }
    none += found.local < 0;
  }
  EXPECT_GT(none, 10);
  EXPECT_LT(none, 190);
}

}  // namespace
}  // namespace unseen::planes
