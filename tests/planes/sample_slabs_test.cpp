// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Neighbourhoods in a survey's sample, against looking at every point of it.
#include "planes/scan/sample_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

Survey survey_of(LargeVector<Vec3> sample) {
  Survey s;
  s.low.setConstant(std::numeric_limits<double>::infinity());
  s.high = -s.low;
  for (const Vec3& p : sample) s.low = s.low.cwiseMin(p), s.high = s.high.cwiseMax(p);
  s.sample = std::move(sample);
  return s;
}

Neighbourhood by_brute_force(const LargeVector<Vec3>& sample, std::size_t probe, std::size_t points) {
  std::vector<std::pair<double, std::size_t>> all;
  for (std::size_t i = 0; i < sample.size(); ++i) all.emplace_back((sample[i] - sample[probe]).squaredNorm(), i);
  std::sort(all.begin(), all.end());
  Neighbourhood nearest;
  for (std::size_t i = 0; i < std::min(points, all.size()); ++i) nearest.push_back(sample[all[i].second]);
  return nearest;
}

void expect_as_by_brute_force(const Survey& survey) {
  const SampleSlabs slabs(survey);
  const SampleTree tree(survey);
  for (std::size_t probe = 0; probe < survey.sample.size(); probe += 1 + survey.sample.size() / 50)
    for (const std::size_t points : {1, 7, 100}) {
      const Neighbourhood nearest = by_brute_force(survey.sample, probe, points);
      EXPECT_EQ(slabs.around(probe, points), nearest) << probe;
      EXPECT_EQ(tree.around(probe, points), nearest) << probe;
    }
}

TEST(SampleSlabs, FindsTheNearestPoints) {
  Random random(1);
  for (const Vec3& extent : {Vec3(1, 1, 1), Vec3(0.01, 30, 2), Vec3(1e-4, 0, 0)})
    for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(-4e5, 5e6, 100)}) {
      LargeVector<Vec3> sample;
      for (int i = 0; i < 5000; ++i) sample.push_back(origin + Vec3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(extent));
      expect_as_by_brute_force(survey_of(std::move(sample)));
    }
}

TEST(SampleSlabs, FindsTheNearestAcrossWideGaps) {
  Random random(2);
  LargeVector<Vec3> sample;
  for (int i = 0; i < 3000; ++i) sample.push_back(Vec3(i % 3 == 0 ? 50.0 : 0.1 * (i % 2), random.uniform(), random.normal()));
  sample.push_back(Vec3(1000, 0, 0));  // alone
  expect_as_by_brute_force(survey_of(std::move(sample)));
}

TEST(SampleSlabs, PrefersTheFirstOfThoseJustAsFar) {
  LargeVector<Vec3> grid;
  for (int i = 0; i < 4096; ++i) grid.push_back(Vec3((i * 1237 + 11) % 16, i * 31 % 16, i / 256));
  expect_as_by_brute_force(survey_of(std::move(grid)));
}

TEST(SampleSlabs, TakesFewPoints) {
  expect_as_by_brute_force(survey_of({Vec3(1, 2, 3)}));
  expect_as_by_brute_force(survey_of({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3.5)}));
}

}  // namespace
}  // namespace unseen::planes
