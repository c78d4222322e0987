// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "unseen/core/error.h"
#include "unseen/planes/evaluate.h"

namespace unseen::planes {
namespace {

/// Runs of equal values: {{value, count}, …} → one entry a point.
std::vector<int> runs(std::initializer_list<std::pair<int, int>> parts) {
  std::vector<int> values;
  for (const auto& [value, count] : parts)
    values.insert(values.end(), static_cast<std::size_t>(count), value);
  return values;
}

TEST(EvaluateLabels, RenamedRegionsAreAllCorrect) {
  const auto s =
      evaluate_against_labels(runs({{5, 50}, {2, 30}, {9, 20}}), runs({{0, 50}, {1, 30}, {2, 20}}));
  EXPECT_EQ(s.correct, 3u);
  EXPECT_EQ(s.over_segmented + s.under_segmented + s.missed + s.noise, 0u);
  EXPECT_EQ(s.precision, 1.0);
  EXPECT_EQ(s.recall, 1.0);
  EXPECT_EQ(s.f1, 1.0);
}

TEST(EvaluateLabels, OverlapIsAskedOfBothRegions) {
  // 80 of 100 true points found: correct at 0.8, nothing at 0.81.
  const auto found = runs({{0, 80}, {-1, 20}}), truth = runs({{0, 100}});
  EXPECT_EQ(evaluate_against_labels(found, truth, 0.8).correct, 1u);
  const auto strict = evaluate_against_labels(found, truth, 0.81);
  EXPECT_EQ(strict.correct, 0u);
  EXPECT_EQ(strict.missed, 1u);
  EXPECT_EQ(strict.noise, 1u);
}

TEST(EvaluateLabels, HalvesAreOneOverSegmentation) {
  const auto s = evaluate_against_labels(runs({{0, 50}, {1, 50}, {2, 40}}), runs({{0, 100}, {1, 40}}));
  EXPECT_EQ(s.over_segmented, 1u);
  EXPECT_EQ(s.correct, 1u);
  EXPECT_EQ(s.missed, 0u);
  EXPECT_EQ(s.noise, 0u);
  EXPECT_NEAR(s.precision, 1.0 / 3, 1e-15);
  EXPECT_NEAR(s.recall, 0.5, 1e-15);
  EXPECT_NEAR(s.f1, 0.4, 1e-15);
}

TEST(EvaluateLabels, OneRegionForTwoIsAnUnderSegmentation) {
  const auto s = evaluate_against_labels(runs({{0, 100}}), runs({{0, 50}, {1, 50}}));
  EXPECT_EQ(s.under_segmented, 1u);
  EXPECT_EQ(s.correct + s.over_segmented + s.missed + s.noise, 0u);
  EXPECT_EQ(s.f1, 0.0);
}

TEST(EvaluateLabels, RegionCountsWhereItFitsBest) {
  // 0 covers 85 % of the truth and is correct on its own; with 1 it covers all of it, which fits better.
  const auto s = evaluate_against_labels(runs({{0, 85}, {1, 15}}), runs({{0, 100}}));
  EXPECT_EQ(s.over_segmented, 1u);
  EXPECT_EQ(s.correct, 0u);
}

TEST(EvaluateLabels, UnlabelledPointsCountAsSizeAndMakeNoise) {
  const auto s =
      evaluate_against_labels(runs({{0, 100}, {0, 60}, {1, 30}}), runs({{0, 100}, {-1, 60}, {-1, 30}}));
  EXPECT_EQ(s.correct, 0u);  // 100 of the region's 160
  EXPECT_EQ(s.labels, 1u);
  EXPECT_EQ(s.planes, 2u);
  EXPECT_EQ(s.noise, 2u);
  EXPECT_EQ(s.missed, 1u);
  EXPECT_EQ(s.under_segmented, 0u);  // one label is not a merge
}

TEST(EvaluateLabels, NothingFoundAndNothingThere) {
  const auto none = evaluate_against_labels(runs({{-1, 10}}), runs({{0, 10}}));
  EXPECT_EQ(none.missed, 1u);
  EXPECT_EQ(none.f1, 0.0);
  const auto empty = evaluate_against_labels({}, {});
  EXPECT_EQ(empty.planes + empty.labels, 0u);
  EXPECT_THROW(evaluate_against_labels({0}, {}), InputError);
  EXPECT_THROW(evaluate_against_labels({0}, {0}, 0.5), InputError);
}

}  // namespace
}  // namespace unseen::planes
