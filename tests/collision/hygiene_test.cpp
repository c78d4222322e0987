// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What is wrong with a file rather than with what it shows: repeated, missing and broken frames, uneven stamps.
#include "collision/video/repeats.h"
#include "collision/video/time_stamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "collision/video/regions.h"
#include "little_videos.h"
#include "unseen/core/error.h"

namespace unseen::collision::test {
namespace {

// Lamps at 100 Hz, filmed at 120 frames a second: the light comes back every sixth frame, and changes by nothing twice in that time.
TEST(Hygiene, FlickeringLightRepeatsNoFrame) {
  const Scratch scratch("lamp");
  const std::string path = scratch.file("lamp.avi");
  Random random(3);
  const cv::Mat background = wall();
  write_video(path, 40, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, thrown(k), 12.0, kRed);
    frame *= 0.9 + 0.06 * std::sin(2.0 * kPi * k / 6.0);
    add_noise(frame, 0.5, random);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_EQ(std::count(footage.doubled.begin(), footage.doubled.end(), 1), 0);
  EXPECT_FALSE(warned(context, "repeat"));
}

TEST(Hygiene, DoubledFramesAreMarked) {
  const Scratch scratch("doubled");
  const std::string path = scratch.file("doubled.avi");
  Random random(2);
  const cv::Mat background = wall();
  cv::Mat last;
  write_video(path, 30, [&](int k) {
    if (k == 7 || k == 19) return last;
    last = background.clone();
    draw_disc(last, thrown(k), 12.0, kRed);
    add_noise(last, 2.0, random);
    return last;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  for (int k = 0; k < 30; ++k) EXPECT_EQ(footage.doubled[k] != 0, k == 7 || k == 19) << k;
  EXPECT_TRUE(warned(context, "repeat"));
}

TEST(Hygiene, BrokenFilesAreNamed) {
  const Scratch scratch("broken");
  Context context;
  const auto field = [&](const std::string& path) -> std::string {
    try {
      find_regions(shot_of(path), context);
    } catch (const InputError& e) {
      EXPECT_EQ(e.source, path);
      EXPECT_FALSE(e.expected.empty());
      return e.field;
    }
    return "no error";
  };
  EXPECT_EQ(field(scratch.file("none.mp4")), "video");
  std::ofstream(scratch.file("text.mp4")) << "not a video\n";
  EXPECT_EQ(field(scratch.file("text.mp4")), "video");
  std::ofstream(scratch.file("empty.avi"));
  EXPECT_EQ(field(scratch.file("empty.avi")), "video");
  write_video(scratch.file("one.avi"), 1, [](int) { return wall(); });
  EXPECT_EQ(field(scratch.file("one.avi")), "frames");
}

TEST(Hygiene, ATruncatedFileGivesAWarning) {
  const Scratch scratch("cut");
  const std::string whole = scratch.file("whole.avi"), cut = scratch.file("cut.avi");
  Random random(3);
  write_video(whole, 30, [&](int k) {
    cv::Mat frame = wall();
    draw_disc(frame, thrown(k), 12.0, kRed);
    add_noise(frame, 2.0, random);
    return frame;
  });
  std::ifstream in(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size() * 6 / 10));
  Context context;
  const Footage footage = find_regions(shot_of(cut), context);
  EXPECT_LT(footage.times.size(), 22u);
  EXPECT_GT(footage.times.size(), 12u);
  EXPECT_TRUE(warned(context, "announced"));
}

// A file of Matroska whose frames are 1/120 s to 1/30 s apart, and as many announced as there would be at 120 a second.
TEST(Hygiene, UnevenFramesThatLastAsLongAsAnnouncedAreNotCutShort) {
  std::vector<double> stamps = {0.0};
  for (int k = 1; k < 60; ++k) stamps.push_back(stamps.back() + (k % 3 ? 1 : 4) / 120.0);
  EXPECT_TRUE(lasts_as_announced(stamps, 117, 120.0));
  std::fill(stamps.end() - 4, stamps.end(), 0.0);  // the last ones often have none
  EXPECT_TRUE(lasts_as_announced(stamps, 117, 120.0));
  EXPECT_FALSE(lasts_as_announced(stamps, 200, 120.0));  // cut short
  std::vector<double> even;
  for (int k = 0; k < 60; ++k) even.push_back(k / 30.0);
  EXPECT_FALSE(lasts_as_announced(even, 61, 30.0));  // a frame that could not be decoded
}

/// Matroska knows milliseconds only: 600 frames a second are steps of 1 and 2.
TEST(Hygiene, StampsInWholeMillisecondsAreEven) {
  for (const double fps : {240.0, 480.0, 600.0, 720.0, 960.0, 1000.0}) {
    std::vector<double> stamps;
    for (int k = 0; k < 100; ++k) stamps.push_back(k < 98 ? std::round(1000.0 * k / fps) / 1000.0 : 0.0);  // the last ones are often left out
    for (const std::optional<double> given : {std::optional<double>(), std::optional(fps)}) {
      Context context;
      EXPECT_NEAR(frame_times(stamps, fps, given, "v", context)[60], 60.0 / fps, 1e-9) << fps;
      EXPECT_FALSE(warned(context, "uneven")) << fps;
    }
    stamps.erase(stamps.begin() + 50);
    Context context;
    EXPECT_NEAR(frame_times(stamps, fps, fps, "v", context)[90], 91.0 / fps, 0.00051) << fps;
    EXPECT_TRUE(warned(context, "uneven")) << fps;
  }
}

// From 25 to 30 frames a second by repeating every sixth, and compressed again: much less changes there, but not nothing.
TEST(Hygiene, RepeatsOfAConversionAreFoundAndTheOthersSpacedEvenly) {
  Random random(2);
  std::vector<double> change, light;
  for (int k = 0; k < 120; ++k) {
    change.push_back((k % 6 == 5 ? 0.2 : 1.0) * random.uniform(0.7, 1.3));
    light.push_back(100.0 + 0.01 * random.normal());
  }
  const Repeats found = find_repeats(change, light);
  for (int k = 1; k < 120; ++k) EXPECT_EQ(found.doubled[k] != 0, k % 6 == 5) << k;
  std::vector<double> times, holed;
  for (int k = 0; k < 120; ++k) times.push_back(k / 30.0), holed.push_back(k / 30.0 + (k > 60 ? 0.5 : 0.0));
  EXPECT_TRUE(share_out_times(found, times));
  EXPECT_NEAR(times[4], 4 / 25.0, 1e-9);
  EXPECT_NEAR(times[5], times[4], 1e-9);
  EXPECT_NEAR(times[6], 5 / 25.0, 1e-9);
  EXPECT_NEAR(times[119], times[118], 1e-9);
  EXPECT_NEAR(times[118], 99 / 25.0, 1e-9);
  EXPECT_FALSE(share_out_times(found, holed));  // uneven stamps tell better
}

TEST(Hygiene, WhatStandsStillBeforeAndAfterItMovesRepeatsNothing) {
  std::vector<double> change(60, 0.001), light(60, 100.0);
  for (std::size_t k = 20; k < 40; ++k) change[k] = 0.5;
  change[30] = 0.0;
  const Repeats found = find_repeats(change, light);
  for (std::size_t k = 0; k + 1 < change.size(); ++k) EXPECT_EQ(found.doubled[k], k == 30) << k;
}

// A lamp at 100 Hz before 120 frames a second: between two of them it may not change.
TEST(Hygiene, LightThatStandsStillForAFrameRepeatsNothingWhereSomethingMoves) {
  std::vector<double> change, light, moved;
  for (int k = 0; k < 60; ++k) {
    light.push_back(100.0 + 2.0 * std::cos(2.0 * kPi * (k + 0.5) / 6.0));
    change.push_back(k == 0 ? 0.0 : std::abs(light[k] - light[k - 1]) + 0.02);
    moved.push_back(k == 0 ? 0.0 : 0.05);
  }
  moved[31] = change[31] = 0.0;
  const Repeats found = find_repeats(change, light, moved);
  EXPECT_EQ(std::count(found.doubled.begin(), found.doubled.end(), 1), 1);
  EXPECT_TRUE(found.doubled[31]);
}

/// Changes of 120 frames by their phase in a period.
std::vector<double> changes_by_phase(const std::vector<double>& phases) {
  Random random(2);
  std::vector<double> change;
  for (std::size_t k = 0; k < 120; ++k) change.push_back(phases[k % phases.size()] * random.uniform(0.9, 1.1));
  return change;
}

TEST(Hygiene, WhatChangesLessAtRegularPlacesMayBeNoConversion) {
  const std::vector<double> even(120, 100.0);
  EXPECT_FALSE(find_repeats(changes_by_phase({1, 1, 1, 1, 1, 0.2}), even).converted.empty());
  EXPECT_FALSE(find_repeats(changes_by_phase({1, 0.2, 1, 0.2, 0.2}), even).converted.empty());  // 24 to 60
  std::vector<double> lamp;
  for (int k = 0; k < 120; ++k) lamp.push_back(100.0 + 3.0 * std::sin(2.0 * kPi * k / 6.0));
  EXPECT_TRUE(find_repeats(changes_by_phase({1, 1, 1, 1, 1, 0.2}), lamp).converted.empty());
  EXPECT_TRUE(find_repeats(changes_by_phase({0.5, 0.87, 1, 0.87, 0.5, 0.05}), even).converted.empty());  // something swings
  EXPECT_TRUE(find_repeats(changes_by_phase({1, 0.17, 0.17, 0.17}), even).converted.empty());            // a screen at 15 frames a second
  const Repeats lost = find_repeats(changes_by_phase({2, 1, 1, 1, 1, 0.2}), even);                       // a repeat in place of a lost frame
  EXPECT_TRUE(lost.converted.empty());
  std::vector<double> single = changes_by_phase({1, 1, 1, 1, 1, 0.2});
  single[62] = 0.0;  // a frame of its own
  EXPECT_TRUE(find_repeats(single, even).doubled[62]);
}

// Little moves, and what compression changes hides where it does.
TEST(Hygiene, WhatMovesTellsOfAConversionWhereCompressionHidesIt) {
  for (const std::vector<double>& phases : {std::vector<double>{1, 0, 1, 0, 0}, {1, 0}, {1, 1, 1, 1, 0}}) {  // 24 to 60, 30 to 60, 24 to 30
    Random random(5);
    std::vector<double> change, moved = changes_by_phase(phases), light;
    for (std::size_t k = 0; k < moved.size(); ++k) {
      change.push_back(0.1 * moved[k] + random.uniform(0.02, 0.3) * (k % 4 == 3 ? 0.2 : 1.0));  // as every fourth frame is coded
      light.push_back(100.0 + 0.1 * random.normal());
    }
    const Repeats found = find_repeats(change, light, moved);
    ASSERT_FALSE(found.converted.empty()) << phases.size();
    for (std::size_t k = 1; k < moved.size(); ++k) EXPECT_EQ(found.converted[k] != 0, phases[k % phases.size()] == 0) << k;
  }
}

TEST(Hygiene, UnevenStampsAreUsedAndSaid) {
  Context context;
  const std::vector<double> even{0.0, 0.04, 0.08, 0.12}, uneven{0.0, 0.04, 0.08, 0.16, 0.2, 0.24}, broken{0.0, 0.04, 0.08, 0.0};
  EXPECT_NEAR(frame_times(even, 25.0, {}, "v", context)[3], 0.12, 1e-12);
  EXPECT_NEAR(frame_times(broken, 25.0, {}, "v", context)[3], 0.12, 1e-12);
  EXPECT_NEAR(frame_times(even, 25.0, 250.0, "v", context)[3], 0.012, 1e-12);
  EXPECT_FALSE(warned(context, "uneven"));
  for (const double average : {25.0, 20.8}) EXPECT_NEAR(frame_times(uneven, average, {}, "v", context)[5], 0.24, 1e-9);
  EXPECT_NEAR(frame_times(uneven, 20.8, 250.0, "v", context)[5], 0.024, 1e-9);
  EXPECT_TRUE(warned(context, "uneven"));
  const std::vector<double> holed{0.0, 0.04, 0.0, 0.12, 0.16};
  EXPECT_NEAR(frame_times(holed, 25.0, {}, "v", context)[4], 0.16, 1e-9);
}

// A phone that takes fewer pictures a second once it is darker: no step is far from the typical one, and yet the frames drift.
TEST(Hygiene, AChangedRateIsSeenByItsStamps) {
  std::vector<double> stamps{0.0}, shaken;
  for (int k = 1; k < 60; ++k) stamps.push_back(stamps.back() + (k < 25 ? 1.0 / 30.0 : 1.0 / 24.0));
  Context context;
  const std::vector<double> times = frame_times(stamps, 59.0 / stamps.back(), {}, "v", context);
  for (std::size_t k = 0; k < stamps.size(); ++k) EXPECT_NEAR(times[k], stamps[k], 1e-9) << k;
  EXPECT_TRUE(warned(context, "they drift by 2.8"));
  EXPECT_NEAR(frame_times(stamps, 59.0 / stamps.back(), 240.0, "v", context).back(), 59.0 / 240.0, 1e-9);
  for (int k = 0; k < 60; ++k) shaken.push_back((k + 0.1 * (k % 2)) / 30.0);  // stamps of an even rate, told a little early and late
  Context even;
  EXPECT_NEAR(frame_times(shaken, 30.0, {}, "v", even)[41], 41.0 / 30.0, 1e-9);
  EXPECT_FALSE(warned(even, "uneven"));
}

}  // namespace
}  // namespace unseen::collision::test
