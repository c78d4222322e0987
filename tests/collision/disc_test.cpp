// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace unseen::collision::test {
namespace {

/// A region of all pixels of a 160 × 160 picture that are `inside`, with the sizes that describe_part() would find.
Region region_of(const std::function<bool(double, double)>& inside, double diameter, double circle) {
  Region region;
  region.box = {20, 30, 160, 160};
  region.mask = cv::Mat::zeros(160, 160, CV_8U);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x)
      if (inside(x, y)) region.mask.at<unsigned char>(y, x) = 255, region.area += 1.0;
  region.diameter = diameter;
  region.circle = circle;
  return region;
}

TEST(Disc, TheRestOfACoveredOneIsFound) {
  const auto disc = [](double x, double y) { return std::hypot(x - 70.3, y - 80.6) < 40.0; };
  const Region covered = region_of([&](double x, double y) { return disc(x, y) && x > 85; }, 23, 76);
  const auto found = covered_disc(covered, {79, 80, 81});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->center.x(), 20 + 70.3, 1.0);
  EXPECT_NEAR(found->center.y(), 30 + 80.6, 0.5);
  EXPECT_NEAR(found->diameter, 80, 2.0);
  EXPECT_FALSE(covered_disc(covered, {50, 51, 52}));  // nothing of that size was ever seen whole
}

TEST(Disc, WhatLiesOnSomethingIsNearlyWhole) {
  const auto cut = [](double share) {  // of the diameter, from below
    return region_of([=](double x, double y) { return std::hypot(x - 70.3, y - 80.6) < 40.0 && y < 120.6 - 80.0 * share; }, 80, 80);
  };
  EXPECT_TRUE(is_nearly_whole(cut(0.04)));
  EXPECT_FALSE(is_nearly_whole(cut(0.2)));
}

TEST(Disc, WholeAndBlurredOnesAreNotChanged) {
  const Region whole = region_of([](double x, double y) { return std::hypot(x - 70.3, y - 80.6) < 40.0; }, 80, 81);
  EXPECT_TRUE(is_disc(whole));
  EXPECT_FALSE(covered_disc(whole, {79, 80, 81}));
  const Region blurred = region_of([](double x, double y) { return std::hypot(x - 70.3, y - std::clamp(y, 60.0, 95.0)) < 30.0; }, 60, 95);
  EXPECT_FALSE(is_disc(blurred));
  EXPECT_FALSE(covered_disc(blurred, {59, 60, 61}));
}

}  // namespace
}  // namespace unseen::collision::test
