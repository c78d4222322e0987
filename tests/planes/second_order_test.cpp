// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Equal steps between parallel planes.
#include <gtest/gtest.h>

#include "planes/result/describe.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

/// Parallel planes at these offsets (m), in any order; at a scale of 5 cm offsets count as equal within 1.25 cm.
Arrangement parallel(const std::vector<double>& offsets) {
  Arrangement a;
  a.scale = 0.05;
  a.directions.push_back({Vec3::UnitX(), 0});
  for (const double offset : offsets) {
    ArrangedPlane p;
    p.plane = {Vec3::UnitX(), offset};
    p.direction = p.frame = 0;
    a.planes.push_back(p);
  }
  find_second_order(a);
  return a;
}

TEST(EqualSteps, OfAStairAreOneRun) {
  const Arrangement a = parallel({0.0, 0.17, 0.34, 0.51, 0.68, 3.0});
  ASSERT_EQ(a.spacing.size(), 1u);
  EXPECT_EQ(a.spacing[0].planes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_NEAR(a.spacing[0].step, 0.17, 1e-12);
}

TEST(EqualSteps, OfWindowsAreOneRowASide) {  // 1.1 m wide, every 2 m
  std::vector<double> offsets = {0.0, 14.3};
  for (int k = 0; k < 6; ++k) offsets.push_back(1.0 + 2.0 * k), offsets.push_back(2.1 + 2.0 * k + (k == 2 ? 0.004 : 0.0));
  const Arrangement a = parallel(offsets);
  ASSERT_EQ(a.spacing.size(), 2u);
  for (int side : {0, 1}) {
    EXPECT_EQ(a.spacing[side].planes, (std::vector<int>{2 + side, 4 + side, 6 + side, 8 + side, 10 + side, 12 + side}));
    EXPECT_NEAR(a.spacing[side].step, 2.0, 1e-9);
  }
  EXPECT_NEAR(a.spacing[0].rms, 0.0, 1e-9);
  EXPECT_NEAR(a.spacing[1].rms, 0.004 / std::sqrt(6.0), 1e-9);
}

TEST(EqualSteps, OfAStairWithSomethingBetweenAreOneRow) {
  const Arrangement a = parallel({0.0, 0.17, 0.34, 0.51, 0.57, 0.68, 0.85, 1.02});
  ASSERT_EQ(a.spacing.size(), 1u);
  EXPECT_EQ(a.spacing[0].planes, (std::vector<int>{0, 1, 2, 3, 5, 6, 7}));
}

TEST(EqualSteps, AreHardlyFoundByChance) {  // rows of four are, two hundred times here
  Random random(1);
  for (const bool far : {false, true}) {
    int found = 0;
    for (int k = 0; k < 400; ++k) {
      std::vector<double> offsets;
      for (int i = 0; i < 30; ++i) offsets.push_back(random.uniform(0.0, 10.0));
      if (far) offsets.push_back(100.0);
      for (const Spacing& s : parallel(offsets).spacing) found += s.planes.size() > 3;
    }
    EXPECT_LT(found, 20) << far;
  }
}

}  // namespace
}  // namespace unseen::planes
