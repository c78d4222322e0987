// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/selection.h"

#include <gtest/gtest.h>

#include <set>

#include "planes/selection_problems.h"

namespace unseen::planes {
namespace {

using test::energy_by_definition;
using test::random_problem;

TEST(EnergyOf, IsTheDefinition) {
  Random random(1);
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const SelectionProblem p = random_problem(9, 4, 0.1 * (seed % 11), static_cast<int>(seed % 3), seed);
    Labels labels;
    for (int j = 0; j < p.patches(); ++j) {
      int k = 0;
      do k = static_cast<int>(random.index(p.frames()));
      while (!std::isfinite(p.data(j, k)));
      labels.push_back(k);
    }
    EXPECT_NEAR(energy_of(p, labels).total(), energy_by_definition(p, labels), 1e-12);
  }
}

TEST(EnergyOf, PartsAreWeighted) {
  SelectionProblem p;
  p.lambda = 0.25;
  p.data = Table<double>(2, 2, 0.0);
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < 2; ++k) p.data(j, k) = 2 * j + k + 1;
  p.orientation = Table<int>(2, 2, 0);
  p.orientation(0, 1) = p.orientation(1, 1) = 1;
  p.irregularity = Table<double>(2, 2, 0.0);
  p.irregularity(0, 1) = p.irregularity(1, 0) = 0.4;
  p.fixed = {0, 0};
  p.neighbours = {{0, 1}};
  const Energy e = energy_of(p, {0, 1});
  EXPECT_NEAR(e.data, 0.25 * 5, 1e-15);
  EXPECT_NEAR(e.irregularity, 0.75 * 0.4, 1e-15);
  EXPECT_NEAR(e.smoothness, 0.075, 1e-15);
  EXPECT_EQ(energy_of(p, {0, 0}).irregularity, 0.0);
  p.fixed = {0, 1};  // open without a patch
  EXPECT_NEAR(energy_of(p, {0, 0}).irregularity, 0.3, 1e-15);
}

double brute_force(const SelectionProblem& p) {
  double best = std::numeric_limits<double>::infinity();
  Labels labels(p.patches(), 0);
  while (true) {
    bool possible = true;
    for (int j = 0; j < p.patches(); ++j) possible = possible && std::isfinite(p.data(j, labels[j]));
    if (possible) best = std::min(best, energy_by_definition(p, labels));
    int j = 0;
    while (j < p.patches() && ++labels[j] == p.frames()) labels[j++] = 0;
    if (j == p.patches()) return best;
  }
}

TEST(SolveLocal, FindsTheBestOfAllLabelingsOfTinyProblems) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const SelectionProblem p =
        random_problem(4 + seed % 2, 3, 0.1 + 0.2 * (seed % 5), static_cast<int>(seed % 2), seed);
    const double best = brute_force(p);
    const Labels labels = solve_local(p, test::kContext);
    EXPECT_NEAR(energy_of(p, labels).total(), best, 1e-9 + 1e-6 * best) << "seed " << seed;
    const double bound = lower_bound(p, energy_of(p, labels).total(), test::kContext);
    EXPECT_LE(bound, best + 1e-9) << "seed " << seed;
    EXPECT_GE(bound, 0.0);
  }
}

Labels local_fits(const SelectionProblem& p) {
  Labels labels;
  for (int j = 0; j < p.patches(); ++j) labels.push_back(p.frames() - p.patches() + j);
  return labels;
}

TEST(SolveLocal, IsNeverWorseThanEveryLocalFit) {
  for (const double lambda : {0.05, 0.3, 0.5, 0.7, 0.95, 0.99, 1.0})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const SelectionProblem p = random_problem(30, 8, lambda, 0, seed);
      EXPECT_LE(energy_of(p, solve_local(p, test::kContext)).total(), energy_of(p, local_fits(p)).total() + 1e-9)
          << "lambda " << lambda << " seed " << seed;
    }
}

TEST(SolveLocal, LambdaOneKeepsEveryLocalFit) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const SelectionProblem p = random_problem(25, 6, 1.0, 0, seed);
    EXPECT_EQ(solve_local(p, test::kContext), local_fits(p));
  }
}

/// With λ = 0 only frames and seams cost; as every patch has a candidate of the first frames, one frame is
/// enough.
TEST(SolveLocal, LambdaZeroAsksForOneFrame) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SelectionProblem p = random_problem(20, 5, 0.0, 0, seed);
    for (int j = 0; j < p.patches(); ++j)
      for (int k = 0; k < 5; ++k) {
        if (!std::isfinite(p.data(j, k))) p.data(j, k) = 50;
        p.orientation(j, k) = k;
      }
    const Labels labels = solve_local(p, test::kContext);
    EXPECT_EQ(std::set<int>(labels.begin(), labels.end()).size(), 1u);
    EXPECT_EQ(energy_of(p, labels).data + energy_of(p, labels).irregularity, 0.0);
  }
}

TEST(SolveLocal, GivenAStartItIsNeverWorse) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const SelectionProblem p = random_problem(100, 10, 0.5, 0, seed);  // beyond the exhaustive size
    const double start = energy_of(p, local_fits(p)).total();
    EXPECT_LE(energy_of(p, solve_local(p, test::kContext, local_fits(p))).total(), start + 1e-9);
  }
}

TEST(SolveLocal, FixedFramesCostWhetherTheyServeOrNot) {
  const SelectionProblem p = random_problem(10, 4, 0.5, 2, 3);
  const Labels labels = solve_local(p, test::kContext);
  EXPECT_GE(energy_of(p, labels).irregularity, 0.5 * p.irregularity(0, 1) - 1e-12);
}

TEST(SolveLocal, StopsOnRequest) {
  std::stop_source stop;
  Context context;
  context.stop = stop.get_token();
  stop.request_stop();
  const SelectionProblem p = random_problem(20, 5, 0.5, 0, 1);
  EXPECT_ANY_THROW(solve_local(p, context));
  EXPECT_ANY_THROW(lower_bound(p, 100, context));
  EXPECT_ANY_THROW(solve_exact(p, Labels(20, 0), 1, context));
}

TEST(LowerBound, IsTightWithoutSeams) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SelectionProblem p = random_problem(5, 3, 0.5, 0, seed);
    p.neighbours.clear();
    const double best = brute_force(p);
    EXPECT_NEAR(lower_bound(p, best + 1e-9, test::kContext), best, 1e-6);
  }
}

}  // namespace
}  // namespace unseen::planes
