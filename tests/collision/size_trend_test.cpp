// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/size_trend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// A ball that flies off with `speed` (m/s) from 2.5 m, for 0.4 s, its sizes off by `scale` alike, with `noise` each, of which
/// `alike` is the correlation from frame to frame.
Problem flight(double speed, double scale, double noise, Random& random, double alike = 0.0) {
  Problem problem;
  problem.camera = {1000, 1000, 640, 360, 1280, 720};
  Body ball;
  ball.radius = 0.1;
  problem.solids = {solid_of(ball, "test"), solid_of(ball, "test")};
  problem.fixed = problem.filmed = true;
  double error = random.normal();
  for (int k = 0; k <= 48; ++k, error = alike * error + std::sqrt(1.0 - alike * alike) * random.normal()) {
    const double t = k / 120.0, depth = (2.5 + speed * t) * scale * std::exp(noise * error);
    problem.points.push_back({0, false, k, t, Vec2::Zero(), depth, 0.04});
  }
  return problem;
}

TEST(SizeTrend, IsTheChangeOfDistanceWhateverTheScale) {
  Random random(1);
  for (const double speed : {-1.5, 0.0, 2.0})
    for (const double scale : {0.9, 1.0, 1.1}) {
      const std::vector<SizeTrend> trends = size_trends(flight(speed, scale, 0.002, random));
      ASSERT_EQ(trends.size(), 1u);
      EXPECT_EQ(trends[0].begin, 0.0);
      EXPECT_EQ(trends[0].end, 0.4);
      EXPECT_NEAR(trends[0].change, std::log((2.5 + 0.4 * speed) / 2.5), 3.0 * trends[0].sigma);
      EXPECT_LT(trends[0].sigma, 0.01);
    }
}

TEST(SizeTrend, AFewWrongSizesDoNotCount) {
  Random random(2);
  Problem problem = flight(1.0, 1.0, 0.002, random);
  for (std::size_t i = 40; i < 46; ++i) problem.points[i].depth *= 1.2;
  const std::vector<SizeTrend> trends = size_trends(problem);
  ASSERT_EQ(trends.size(), 1u);
  EXPECT_NEAR(trends[0].change, std::log(2.9 / 2.5), 0.012);
}

/// Mean of the deviations told over what they are in 200 flights.
double told_of_true(double alike) {
  Random random(3);
  constexpr int kFlights = 200;
  constexpr double kNoise = 0.03;  // much more than what is not random
  double squares = 0.0, told = 0.0;
  for (int i = 0; i < kFlights; ++i) {
    const SizeTrend trend = size_trends(flight(1.0, 1.0, kNoise, random, alike)).front();
    squares += std::pow(trend.change - std::log(2.9 / 2.5), 2) / kFlights;
    told += trend.sigma / kFlights;
  }
  return told / std::sqrt(squares);
}

TEST(SizeTrend, ItsDeviationIsThatOfRepeatedFlights) { EXPECT_NEAR(told_of_true(0.0), 1.0, 0.2); }

/// Spots of a ball that turns come to its rim and go again; they would pass for a trend.
TEST(SizeTrend, ItsDeviationCountsErrorsThatGoOnAlike) { EXPECT_NEAR(told_of_true(0.8), 1.0, 0.4); }

TEST(SizeTrend, FewSightingsTellNone) {
  Random random(4);
  Problem problem = flight(1.0, 1.0, 0.0, random);
  problem.points.resize(7);
  EXPECT_TRUE(size_trends(problem).empty());
}

}  // namespace
}  // namespace unseen::collision
