// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Equal steps between parallel planes.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "planes/result/describe.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

/// Parallel planes at these offsets (m), in any order; at a scale of 5 cm, and this noise, offsets count as equal within 1.25 cm.
Arrangement parallel(const std::vector<double>& offsets, double noise = 0.00625, double rounding = 0.0) {
  Arrangement a;
  a.scale = 0.05;
  a.directions.push_back({Vec3::UnitX(), 0});
  for (const double offset : offsets) {
    ArrangedPlane p;
    p.plane = {Vec3::UnitX(), offset};
    p.direction = p.frame = 0;
    p.rms = noise;
    a.planes.push_back(p);
  }
  find_second_order(a, rounding);
  return a;
}

/// Thirty values drawn at random, and one `far` beyond all of them if asked for.
std::vector<double> drawn(double low, double high, std::optional<double> far, Random& random) {
  std::vector<double> values;
  for (int i = 0; i < 30; ++i) values.push_back(random.uniform(low, high));
  if (far) values.push_back(*far);
  return values;
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

// A stair whose steps differ by a centimetre, scanned with a noise of 3 mm, has no equal steps.
TEST(EqualSteps, AreNoneThatTheNoiseTellsApart) {
  const std::vector<double> offsets = {0.0, 0.175, 0.360, 0.525, 0.705, 0.875, 1.065, 1.240, 1.399};
  EXPECT_TRUE(parallel(offsets, 0.003).spacing.empty());
  EXPECT_EQ(parallel({0.0, 0.175, 0.351, 0.524, 0.700}, 0.003).spacing.size(), 1u);
  EXPECT_EQ(parallel({0.0, 0.175, 0.350, 0.525}, 0.0).spacing.size(), 1u);         // of a model
  EXPECT_EQ(parallel({0.0, 0.17, 0.35, 0.52, 0.70}, 0.0, 0.01).spacing.size(), 1u);  // the same in coordinates of two decimals
  EXPECT_TRUE(parallel({0.0, 0.17, 0.35, 0.52, 0.70}, 0.0).spacing.empty());
}

TEST(EqualSteps, OfThreePlanesAreNoneAmongMany) {
  Random random(2);
  for (const std::optional<double> far : {std::optional<double>(), std::optional(100.0)}) {
    std::size_t found = 0;
    for (int k = 0; k < 200; ++k) found += parallel(drawn(0.0, 4.0, far, random), 0.004).spacing.size();
    EXPECT_LT(found, 20u) << far.has_value();  // there are three or so each time
  }
}

/// Level rectangles of these lengths and a width of 0.6 m, each turned by an angle of its own.
Arrangement level(const std::vector<double>& lengths, Random& random) {
  Arrangement a;
  a.scale = 0.08;
  a.directions.push_back({Vec3::UnitZ(), 0});
  for (const double length : lengths) {
    ArrangedPlane p;
    p.plane = {Vec3::UnitZ(), 0.7 + 0.05 * static_cast<double>(a.planes.size())};
    p.direction = p.frame = 0;
    p.rms = 0.003;
    const double turn = random.uniform(0.0, kPi);
    const Vec3 u(std::cos(turn), std::sin(turn), 0), v(-std::sin(turn), std::cos(turn), 0), c(random.uniform(0, 9), random.uniform(0, 9), p.plane.offset);
    p.polygon = {{c, c + length * u, c + length * u + 0.6 * v, c + 0.6 * v}};
    a.planes.push_back(p);
  }
  find_second_order(a);
  return a;
}

TEST(EqualLengths, AreThoseOfThePlanesHoweverTheyAreTurned) {
  Random random(3);
  const Arrangement a = level({1.4, 1.4, 1.405, 1.4, 1.395, 2.2, 0.9}, random);
  ASSERT_EQ(a.equal_lengths.size(), 1u);
  EXPECT_EQ(a.equal_lengths[0].planes, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_NEAR(a.equal_lengths[0].length, 1.4, 1e-9);
  EXPECT_NEAR(a.equal_lengths[0].rms, std::sqrt(2.0 / 5.0) * 0.005, 1e-9);
}

TEST(EqualLengths, AreNoneAmongManyByChance) {
  Random random(4);
  for (const std::optional<double> floor : {std::optional<double>(), std::optional(20.0)}) {
    std::size_t found = 0;
    for (int k = 0; k < 50; ++k) found += level(drawn(0.7, 1.4, floor, random), random).equal_lengths.size();
    EXPECT_LT(found, 25u) << floor.has_value();  // there are three or four each time
  }
}

TEST(EqualSteps, AreHardlyFoundByChance) {  // rows of four are, two hundred times here
  Random random(1);
  for (const std::optional<double> far : {std::optional<double>(), std::optional(100.0)}) {
    int found = 0;
    for (int k = 0; k < 400; ++k)
      for (const Spacing& s : parallel(drawn(0.0, 10.0, far, random)).spacing) found += s.planes.size() > 3;
    EXPECT_LT(found, 20) << far.has_value();
  }
}

}  // namespace
}  // namespace unseen::planes
