// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <limits>

#include <Eigen/LU>

#include "planes/arrange.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

Surface surface_of(int frame, int local, const Vec3& normal, double variance_u, double variance_v,
                   Random& random) {
  Surface s;
  s.frame = frame;
  s.local = local;
  s.support.fit.normal = normal.normalized();
  s.support.fit.u = any_orthogonal(s.support.fit.normal);
  s.support.fit.v = s.support.fit.normal.cross(s.support.fit.u);
  s.support.variance_u = variance_u;
  s.support.variance_v = variance_v;
  s.support.moments = {100, 5.0 * random.direction(), Mat3::Identity()};
  return s;
}

/// Frames turned at random about a shared vertical, with a relation or two, and surfaces whose fits are
/// tilted by noise; the frames themselves start out off by a degree.
Model random_model(std::uint64_t seed, int frames) {
  Random random(seed);
  Model m;
  m.locals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  std::vector<Mat3> truth;
  for (int f = 0; f < frames; ++f) {
    truth.push_back(Eigen::AngleAxisd(random.uniform(0.1, 1.4), Vec3::UnitZ()).toRotationMatrix());
    const Vec3 w = radians(1.0) * random.direction();
    m.frames.push_back({turned(truth.back(), w), true});
    if (f == 0) continue;
    const int b = static_cast<int>(random.index(f));
    if (f % 3 != 2) {  // parallel verticals: two rows
      m.constraints.push_back({f, b, Vec3::UnitZ(), Vec3::UnitX(), 0.0});
      m.constraints.push_back({f, b, Vec3::UnitZ(), Vec3::UnitY(), 0.0});
    } else {  // an angle of 45° or so between two axes
      m.constraints.push_back({f, b, Vec3::UnitX(), Vec3::UnitY(), truth[f].col(0).dot(truth[b].col(1))});
    }
  }
  for (int i = 0; i < 6 * frames; ++i) {
    const int f = i % frames, l = (i / frames) % 3;
    const double sigma = radians(random.uniform(0.1, 1.0));
    const Vec3 n = truth[f].col(l) + sigma * random.normal() * any_orthogonal(truth[f].col(l)) +
                   sigma * random.normal() * truth[f].col(l).cross(any_orthogonal(truth[f].col(l)));
    m.surfaces.push_back(surface_of(f, l, n, sigma * sigma, random.uniform(0.2, 5) * sigma * sigma, random));
  }
  return m;
}

/// Huber's loss: squares that go on as straight lines beyond two standard errors.
double huber(double tilt, double variance) {
  const double s = std::abs(tilt) / std::sqrt(variance);
  return s < 2.0 ? s * s : 4.0 * s - 4.0;
}

/// Σ of the tilts' losses by their variances (the method adds 0.01° to every standard error), written anew.
double objective(const Model& m) {
  const double floor = std::pow(radians(0.01), 2);
  double sum = 0;
  for (const Surface& s : m.surfaces) {
    const Vec3 n = m.frames[s.frame].axes * m.locals[s.local];
    sum += huber(n.dot(s.support.fit.u), s.support.variance_u + floor) + huber(n.dot(s.support.fit.v), s.support.variance_v + floor);
  }
  return sum;
}

Eigen::VectorXd constraint_values(const Model& m) {
  Eigen::VectorXd values(m.constraints.size());
  for (std::size_t i = 0; i < m.constraints.size(); ++i) {
    const Constraint& c = m.constraints[i];
    values[i] = (m.frames[c.a].axes * c.u).dot(m.frames[c.b].axes * c.v) - c.cosine;
  }
  return values;
}

Model moved(const Model& m, const Eigen::VectorXd& w) {
  Model result = m;
  for (std::size_t f = 0; f < m.frames.size(); ++f) {
    const Vec3 turn = w.segment<3>(3 * static_cast<int>(f));
    if (turn.norm() > 0)
      result.frames[f].axes = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * m.frames[f].axes;
  }
  return result;
}

class Refit : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Frames, Refit, testing::Values(1, 2, 3, 5, 8));

TEST_P(Refit, KeepsEveryRelationExactly) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Model m = random_model(seed, GetParam());
    if (!m.constraints.empty()) {
      ASSERT_GT(constraint_values(m).cwiseAbs().maxCoeff(), 1e-4);
    }
    refit(m);
    if (!m.constraints.empty()) {
      EXPECT_LT(constraint_values(m).cwiseAbs().maxCoeff(), 1e-10) << "seed " << seed;
    }
    for (const OrientationFrame& f : m.frames) {
      EXPECT_LT((f.axes.transpose() * f.axes - Mat3::Identity()).norm(), 1e-14);
      EXPECT_GT(f.axes.determinant(), 0.0);
    }
    for (const Surface& s : m.surfaces) EXPECT_NEAR(s.offset, m.normal(s).dot(s.support.moments.mean), 1e-12);
  }
}

/// At the optimum the objective's gradient has no part along the manifold that the constraints leave.
TEST_P(Refit, IsStationaryAlongTheConstraints) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Model m = random_model(seed, GetParam());
    refit(m);
    const int n = 3 * GetParam(), rows = static_cast<int>(m.constraints.size());
    constexpr double h = 1e-5;
    Eigen::VectorXd gradient(n);
    Eigen::MatrixXd jacobian(rows, n);
    for (int i = 0; i < n; ++i) {
      const Model plus = moved(m, h * Eigen::VectorXd::Unit(n, i)),
                  minus = moved(m, -h * Eigen::VectorXd::Unit(n, i));
      gradient[i] = (objective(plus) - objective(minus)) / (2 * h);
      if (rows > 0) jacobian.col(i) = (constraint_values(plus) - constraint_values(minus)) / (2 * h);
    }
    Eigen::VectorXd free = gradient;
    if (rows > 0)
      free -= jacobian.transpose() * (jacobian * jacobian.transpose()).fullPivLu().solve(jacobian * gradient);
    // Gradients of single surfaces are of the size 1/σ ≈ 10²…10³.
    EXPECT_LT(free.norm(), 0.05) << "seed " << seed;
  }
}

/// No feasible model near it is better.
TEST_P(Refit, NoFeasibleNeighbourIsBetter) {
  Random random(77);
  Model m = random_model(3, GetParam());
  refit(m);
  const double least = objective(m);
  const int n = 3 * GetParam();
  for (int trial = 0; trial < 300; ++trial) {
    Eigen::VectorXd w(n);
    for (int i = 0; i < n; ++i) w[i] = radians(0.3) * random.normal() * (trial % 3 == 0 ? 0.1 : 1.0);
    Model other = moved(m, w);
    for (int i = 0; i < 20 && !m.constraints.empty(); ++i) {  // Gauss–Newton back onto the constraints
      const Eigen::VectorXd c = constraint_values(other);
      Eigen::MatrixXd jacobian(c.size(), n);
      for (int k = 0; k < n; ++k)
        jacobian.col(k) = (constraint_values(moved(other, 1e-6 * Eigen::VectorXd::Unit(n, k))) - c) / 1e-6;
      other = moved(other, -jacobian.transpose() * (jacobian * jacobian.transpose()).fullPivLu().solve(c));
    }
    if (!m.constraints.empty()) {
      ASSERT_LT(constraint_values(other).cwiseAbs().maxCoeff(), 1e-9);
    }
    EXPECT_GE(objective(other), least - 1e-6);
  }
}

Model one_frame() {
  Model m;
  m.locals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  m.frames = {{Mat3::Identity(), true}};
  return m;
}

/// One frame, two equally certain fits that are 90° + 2e apart: each turns by e.
TEST(RefitModel, SplitsTheErrorOfTwoEqualFits) {
  Random random(1);
  Model m = one_frame();
  const double e = radians(0.4);
  m.surfaces = {surface_of(0, 0, {std::cos(e), -std::sin(e), 0}, 1e-5, 1e-5, random),
                surface_of(0, 1, {-std::sin(e), std::cos(e), 0}, 1e-5, 1e-5, random)};
  refit(m);
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[0]), m.surfaces[0].support.fit.normal), e, 1e-9);
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[1]), m.surfaces[1].support.fit.normal), e, 1e-9);
  EXPECT_NEAR(m.normal(m.surfaces[0]).dot(m.normal(m.surfaces[1])), 0.0, 1e-15);
}

/// With variances 1 : 3 the errors go 1 : 3.
TEST(RefitModel, WeighsByVariance) {
  Random random(2);
  Model m = one_frame();
  const double e = radians(0.4), floor = std::pow(radians(0.01), 2), variance = 1e-5;
  m.surfaces = {
      surface_of(0, 0, {std::cos(e), -std::sin(e), 0}, variance, variance, random),
      surface_of(0, 1, {0, 1, 0}, 3 * (variance + floor) - floor, 3 * (variance + floor) - floor, random)};
  refit(m);
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[0]), m.surfaces[0].support.fit.normal), e / 4, 1e-7);
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[1]), m.surfaces[1].support.fit.normal), 3 * e / 4, 1e-7);
}

/// One that is a hundred standard errors off pulls with the force of two.
TEST(RefitModel, OddSurfacesHardlyCount) {
  Random random(2);
  Model m = one_frame();
  const double sigma = radians(0.05), floor = std::pow(radians(0.01), 2), variance = sigma * sigma - floor, e = 100.0 * sigma;
  m.surfaces = {surface_of(0, 0, {1, 0, 0}, variance, variance, random), surface_of(0, 1, {std::sin(e), std::cos(e), 0}, variance, variance, random)};
  refit(m);
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[0]), Vec3::UnitX()), 2.0 * sigma, 0.02 * sigma);
}

/// Of correlated noise a large surface averages less away than its points are many; it still tells more than a small one.
TEST(RefitModel, LargeSurfacesTellMore) {
  Random random(2);
  Model m = one_frame();
  const double e = radians(0.1);
  m.surfaces = {surface_of(0, 0, {1, 0, 0}, 0.0, 0.0, random), surface_of(0, 1, {std::sin(e), std::cos(e), 0}, 0.0, 0.0, random)};
  for (Surface& s : m.surfaces) s.support.fit.rms = 0.01, s.support.moments.count = 1e5;
  m.surfaces[0].support.fit.spread_u = m.surfaces[0].support.fit.spread_v = 10.0;
  m.surfaces[1].support.fit.spread_u = m.surfaces[1].support.fit.spread_v = 0.5;
  refit(m);
  const auto variance = [](double spread) { return 0.01 * 0.01 / (60.0 * spread * spread) + std::pow(radians(0.01), 2); };
  EXPECT_NEAR(line_angle(m.normal(m.surfaces[0]), Vec3::UnitX()), e * variance(10.0) / (variance(10.0) + variance(0.5)), 0.01 * e);
}

/// A ground whose tilt is certain, and ten small tops that agree on another, which suits the frame: they outvote it.
Model ground_and_tops(double ground_rms, double tilt = radians(0.8)) {
  Random random(4);
  Model m = one_frame();
  m.surfaces.push_back(surface_of(0, 2, {std::sin(tilt), 0, std::cos(tilt)}, 0.0, 0.0, random));
  for (int i = 0; i < 10; ++i) m.surfaces.push_back(surface_of(0, 2, Vec3::UnitZ(), 0.0, 0.0, random));
  for (Surface& s : m.surfaces) {
    const bool ground = &s == &m.surfaces.front();
    s.support.moments.count = ground ? 1e5 : 300;
    s.support.fit.rms = ground ? ground_rms : 0.02;
    s.support.fit.spread_u = s.support.fit.spread_v = ground ? 35.0 : 1.0;
  }
  return m;
}

TEST(RefitHeld, ManySmallSurfacesDoNotCarryALargeOneAway) {
  Model m = ground_and_tops(0.03);
  const Vec3 ground = m.surfaces[0].support.fit.normal;
  Model plain = m;
  refit(plain);
  EXPECT_GT(degrees(line_angle(plain.normal(plain.surfaces[0]), ground)), 0.5);  // 0.3 m off, one spread from its centre
  refit_held(m, 0.3, Space());
  EXPECT_LT(degrees(line_angle(m.normal(m.surfaces[0]), ground)), 1e-6);
  for (std::size_t i = 1; i < m.surfaces.size(); ++i) EXPECT_EQ(m.surfaces[i].frame, 0);
  EXPECT_LT(degrees(line_angle(m.normal(m.surfaces[1]), Vec3::UnitZ())), 1e-3);
}

// As of photogrammetry, whose noise is that of bumps: the turn takes the points farther off than they lie off their own fit.
TEST(RefitHeld, ARoughSurfaceIsNotCarriedAwayEither) {
  Model m = ground_and_tops(0.4);
  const Vec3 ground = m.surfaces[0].support.fit.normal;
  refit_held(m, 0.3, Space());
  EXPECT_LT(degrees(line_angle(m.normal(m.surfaces[0]), ground)), 1e-6);
}

// A smooth surface that is known to ten standard errors is not carried away by much more than it is rough, however coarse the scale.
TEST(RefitHeld, ASmoothSurfaceIsNotCarriedAwayAtACoarseScale) {
  Model m = ground_and_tops(0.003, radians(0.4));
  refit_held(m, 4.0, Space());  // off by 0.24 m, one spread from its centre
  EXPECT_NE(m.surfaces[0].frame, 0);
}

// A line in one row of pixels has no width and one tilt: its rounding says how well that is known.
TEST(RefitHeld, ALineInOneRowOfPixelsIsNoSurerThanItsRounding) {
  Patch line;
  for (int x = 0; x < 40; ++x) line.moments += Moments{1.0, Vec3(x, 7, 0), Mat3::Zero()};
  const Space drawing{Vec3::UnitZ()};
  line.fit = fit_plane(line.moments, drawing);
  line.variance_u = std::pow(radians(1.0), 2);
  line.variance_v = 0.0;
  const Vec3 turned(std::sin(radians(2.0)), std::cos(radians(2.0)), 0);
  EXPECT_NEAR(noise_chi2(line, turned), 4.0, 0.2);
}

// The fewer frames are asked for, the surer a surface must be to have its own.
TEST(RefitHeld, OneFrameThatIsAskedForKeepsAll) {
  Model m = ground_and_tops(0.03);
  m.certain = std::numeric_limits<double>::infinity();
  refit_held(m, 0.3, Space());
  EXPECT_EQ(m.surfaces[0].frame, 0);
}

// Its own fit is no better than what the turn costs, or it is turned by little and the scale says that so much does not matter.
TEST(RefitHeld, WhatIsNotFlatStaysInItsFrame) {
  Model rough = ground_and_tops(0.6), coarse = ground_and_tops(0.03, radians(0.4));
  refit_held(rough, 0.3, Space());
  refit_held(coarse, 6.0, Space());
  EXPECT_EQ(rough.surfaces[0].frame, 0);
  EXPECT_EQ(coarse.surfaces[0].frame, 0);
}

// A lane between facades: at a coarse scale too it keeps a crossfall that its own noise shows.
TEST(RefitHeld, WhatIsPlainlyTurnedIsSetFreeAtAnyScale) {
  Model m = ground_and_tops(0.03);
  refit_held(m, 6.0, Space());
  EXPECT_EQ(m.surfaces[0].frame, 1);
}

TEST(RefitHeld, SurfacesSetFreeShareTheirDirection) {
  Model m = ground_and_tops(0.03);
  m.surfaces.push_back(m.surfaces.front());
  refit_held(m, 0.3, Space());
  EXPECT_EQ(m.surfaces.front().frame, m.surfaces.back().frame);
  EXPECT_EQ(m.frames.size(), 2u);
}

TEST(Turned, StaysOrthonormalAndTurnsAsAsked) {
  Random random(3);
  Mat3 axes = Mat3::Identity();
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w = random.uniform(0, 3) * random.direction();
    const Mat3 expected = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * axes;
    axes = turned(axes, w);
    EXPECT_LT((axes - expected).norm(), 1e-13);
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace unseen::planes
