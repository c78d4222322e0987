// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/time_gaps.h"

#include <gtest/gtest.h>

namespace unseen::collision::test {
namespace {

/// A ball's outlines along a parabola, one frame lost after the `lost`th if that is positive.
std::vector<Candidate> flight_of(int frames, int lost) {
  std::vector<Candidate> track;
  for (int i = 0; i < frames; ++i) {
    const double t = i > lost && lost > 0 ? i + 1.0 : i;
    Candidate c;
    c.frame = i;
    c.u = i;
    c.pixel = Vec2(100.0 + 9.0 * t, 300.0 - 14.0 * t + 0.6 * t * t);
    c.diameter = 30.0;
    track.push_back(c);
  }
  return track;
}

TEST(TimeGaps, ALostFrameIsFound) {
  const TimeGaps gaps = find_time_gaps(flight_of(24, 11), 0.3, {});
  ASSERT_EQ(gaps.gaps.size(), 1u);
  EXPECT_EQ(gaps.gaps[0].after, 11);
  EXPECT_TRUE(find_time_gaps(flight_of(24, 0), 0.3, {}).gaps.empty());
}

TEST(TimeGaps, AnOutlineThatTakesInItsShadowIsNone) {
  std::vector<Candidate> track = flight_of(24, 11);
  for (std::size_t i = 12; i < track.size(); ++i) track[i].diameter = 36.0;  // the jump is the outline's
  EXPECT_TRUE(find_time_gaps(track, 0.3, {}).gaps.empty());
}

TEST(TimeGaps, AJumpJustBeforeTheFloorIsNone) {
  EXPECT_TRUE(find_time_gaps(flight_of(24, 19), 0.3, {}).gaps.empty());
}

}  // namespace
}  // namespace unseen::collision::test
