// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The noise of sightings, its size and its shape, and what is to be gained from it.
#include "collision/solve/noise.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "collision/doubts/restitution.h"
#include "collision/solve/best_fit.h"
#include "collision/solve/estimates.h"
#include "collision/solve/solve.h"
#include "collision/solve/unknowns.h"
#include "collision/two_balls.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// ∫ f from −6 to 6.
double integral(const std::function<double(double)>& f) {
  constexpr int kSteps = 12000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += f(-6.0 + (i + 0.5) * 12.0 / kSteps);
  return sum * 12.0 / kSteps;
}

TEST(Noise, DensityOfAnyPowerHasUnitDeviationAndArea) {
  for (const double power : {2.0, 4.0, 8.0}) {
    const auto density = [&](double x) { return std::exp(-std::pow(std::abs(x) / width_of_power(power), power) - log_noise(1.0, power)) / std::sqrt(2.0 * kPi); };
    EXPECT_NEAR(integral(density), 1.0, 1e-6) << power;
    EXPECT_NEAR(integral([&](double x) { return x * x * density(x); }), 1.0, 1e-6) << power;
  }
}

TEST(Noise, FourthPowerOfAFlatResidualIsThePower) {
  for (const double power : {4.0, 8.0})
    for (const double x : {-1.5, -0.2, 0.0, 0.7}) {
      const double r = flat_residual(x, power);
      EXPECT_NEAR(std::pow(r, 4), std::pow(std::abs(x) / width_of_power(power), power), 1e-12);
      EXPECT_EQ(std::signbit(r), std::signbit(x));
    }
}

TEST(Noise, DeviationOfAPowerIsThatOfItsEstimator) {
  std::vector<double> uniform;
  for (int i = 0; i < 100000; ++i) uniform.push_back((i + 0.5) / 50000.0 - 1.0);
  // E ψ² = 1/(2p−1) and E ψ' = 1 for ψ = |x|^(p−1), |x| < 1
  for (const double power : {2.0, 4.0, 8.0}) EXPECT_NEAR(equivalent_deviation(uniform, power), 1.0 / std::sqrt(2.0 * power - 1.0), 1e-3) << power;
  // all alike: each has the leverage 18/36
  EXPECT_NEAR(equivalent_deviation(std::vector<double>(36, -0.7), 4.0), 0.7 / (3.0 * std::sqrt(0.5)), 1e-12);
}

double restitution_at(const Problem& problem, const State& state) { return restitution<double>(problem, state, values_of(problem, state)); }

using Noise = std::function<double(int)>;  // px, of a frame

/// Two balls that meet in closed form, seen with noise.
Problem seen_with(const Noise& noise, int frames) {
  const Shot shot = test::two_balls({0.4, frames, static_cast<int>(test::kMeeting) - frames, 120, {1, 0.2, 0.1}});
  Problem problem;
  problem.camera = shot.camera.camera;
  problem.gravity = shot.gravity;
  problem.pixel_sigma = 1.0;
  for (const int b : {0, 1}) problem.solids[b] = solid_of(shot.bodies[b], "test");
  for (const Sighting& s : shot.observations)
    problem.points.push_back({s.body, s.frame > test::kMeeting, s.frame, s.frame / *shot.fps, s.pixel + Vec2(noise(s.frame), noise(s.frame)), 0.0, 0.0});
  return problem;
}

Solution solved(const Problem& problem) {
  Context context;
  return best_fit(problem, (test::kMeeting + 0.4) / 120.0, 1, context);
}

TEST(Noise, ItsShapeAndDeviationAreFound) {
  Random random(1);
  const Problem normal = solved(seen_with([&](int) { return random.normal(); }, 28)).problem;
  EXPECT_EQ(normal.noise_power, 2.0);
  EXPECT_NEAR(normal.pixel_sigma, 1.0, 0.15);
  const Problem flat = solved(seen_with([&](int) { return 2.0 * random.uniform() - 1.0; }, 28)).problem;
  EXPECT_EQ(flat.noise_power, 8.0);
  EXPECT_NEAR(flat.pixel_sigma, 1.0 / std::sqrt(3.0), 0.08);
}

TEST(Noise, WhatIsNoNoiseIsNotFlat) {
  EXPECT_EQ(solved(seen_with([](int frame) { return std::sin(0.7 * frame); }, 28)).problem.noise_power, 2.0) << "neighbours are off alike";
  Random random(1);
  EXPECT_EQ(solved(seen_with([&](int) { return 2.0 * random.uniform() - 1.0; }, 7)).problem.noise_power, 2.0) << "too few sightings";
  EXPECT_EQ(solved(seen_with([&](int) { return 1e-4 * random.uniform(); }, 28)).problem.noise_power, 2.0) << "no noise";
}

TEST(Noise, FlatNoiseTellsMoreAndItIsTold) {
  constexpr int kRuns = 20;
  Random random(2);
  double as_normal = 0.0, as_flat = 0.0, told = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Solution flat = solved(seen_with([&](int) { return 4.0 * random.uniform() - 2.0; }, 28));
    Problem problem = flat.problem;
    problem.noise_power = 2.0;
    const Fit normal = settle(problem, flat.fit.state);
    ASSERT_TRUE(flat.fit.usable && normal.usable);
    as_flat += std::pow(restitution_at(problem, flat.fit.state) - test::kRestitution, 2);
    add_covariance(flat.problem, flat.fit);
    told += std::pow(restitution_of(flat.problem, flat.fit).sd, 2);
    as_normal += std::pow(restitution_at(problem, normal.state) - test::kRestitution, 2);
  }
  EXPECT_LT(std::sqrt(as_flat / as_normal), 0.8);
  EXPECT_NEAR(std::sqrt(told / as_flat), 1.0, 0.3) << "the deviation told is that of repeated runs";
}

}  // namespace
}  // namespace unseen::collision
