// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Shutters that read a picture row by row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/tracks/rolling_shutter.h"
#include "two_balls.h"
#include "unseen/core/error.h"

namespace unseen::collision::test {
namespace {

Reconstruction solved(const Shot& shot) {
  Context context;
  return reconstruct(shot, {}, context);
}

bool speaks_of_the_shutter(const Reconstruction& result) {
  const auto spoken = [](const auto& texts, const auto& text_of) {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return text_of(t).find("shutter") != std::string::npos; });
  };
  return spoken(result.summary.warnings, [](const std::string& t) { return t; }) && spoken(result.ambiguous, [](const Alternative& a) { return a.what; });
}

TEST(RollingShutter, IsUndoneWhereItIsKnown) {
  for (const double readout : {0.03, -0.02}) {
    Shot shot = two_balls({.after = 9, .from = 20, .readout = readout});
    const Reconstruction ignored = solved(shot);
    ASSERT_TRUE(ignored.restitution) << readout;
    EXPECT_GT(std::abs(ignored.restitution->value - kRestitution), 0.02) << readout;
    shot.camera.readout = readout;
    const Reconstruction undone = solved(shot);
    ASSERT_TRUE(undone.restitution) << readout;
    EXPECT_NEAR(undone.restitution->value, kRestitution, 0.002) << readout;
    EXPECT_NEAR(undone.mass_ratio->value, kMassRatio, 0.005) << readout;
    EXPECT_NEAR(undone.impacts.front().frame, kMeeting + 0.4, 0.02) << readout;
    EXPECT_FALSE(speaks_of_the_shutter(undone)) << readout;
  }
}

TEST(RollingShutter, IsSpokenOfWhereItMayMatter) {
  EXPECT_TRUE(speaks_of_the_shutter(solved(two_balls({.after = 9, .from = 20, .readout = 0.03}))));
  Shot global = two_balls({.after = 9, .from = 20});
  global.camera.readout = 0.0;
  EXPECT_FALSE(speaks_of_the_shutter(solved(global)));
}

TEST(RollingShutter, TakesNoLongerThanAFrame) {
  Shot shot = two_balls({});
  for (const double readout : {0.05, -0.05, std::nan("")}) {
    shot.camera.readout = readout;
    EXPECT_THROW(solved(shot), InputError) << readout;
  }
}

TEST(RollingShutter, ReadsTheSensorsRowsFromTheFirst) {
  // A pixel in the sensor's first row, where it lies in a picture that was turned clockwise.
  const Camera level{1000, 1000, 639.5, 359.5, 1280, 720}, upright{1000, 1000, 359.5, 639.5, 720, 1280};
  EXPECT_DOUBLE_EQ(row_share({100.0, -0.5}, level, 0), -0.5);
  EXPECT_DOUBLE_EQ(row_share({719.5, 100.0}, upright, 90), -0.5);
  EXPECT_DOUBLE_EQ(row_share({1179.0, 719.5}, level, 180), -0.5);
  EXPECT_DOUBLE_EQ(row_share({-0.5, 1179.0}, upright, 270), -0.5);
  EXPECT_DOUBLE_EQ(row_share({100.0, 719.5}, level, 0), 0.5);
}

}  // namespace
}  // namespace unseen::collision::test
