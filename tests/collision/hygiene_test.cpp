// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What is wrong with a file rather than with what it shows: repeated, missing and broken frames, uneven stamps.
#include "collision/hygiene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "collision/regions.h"
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

/// Matroska knows milliseconds only: 600 frames a second are steps of 1 and 2.
TEST(Hygiene, StampsInWholeMillisecondsAreEven) {
  for (const double fps : {240.0, 600.0}) {
    std::vector<double> stamps;
    for (int k = 0; k < 100; ++k) stamps.push_back(std::round(1000.0 * k / fps) / 1000.0);
    for (const std::optional<double> given : {std::optional<double>(), std::optional(fps)}) {
      Context context;
      EXPECT_NEAR(frame_times(stamps, fps, given, "v", context)[60], 60.0 / fps, 1e-9) << fps;
      EXPECT_FALSE(warned(context, "uneven")) << fps;
    }
    stamps.erase(stamps.begin() + 50);
    stamps.erase(stamps.begin() + 50);
    Context context;
    EXPECT_NEAR(frame_times(stamps, fps, fps, "v", context)[90], 92.0 / fps, 0.001) << fps;
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
  EXPECT_DOUBLE_EQ(found.frames_each, 1.2);
  std::vector<double> times;
  for (int k = 0; k < 120; ++k) times.push_back(k / 30.0);
  share_out_times(found, times);
  EXPECT_NEAR(times[4], 4 / 25.0, 1e-9);
  EXPECT_NEAR(times[5], times[4], 1e-9);
  EXPECT_NEAR(times[6], 5 / 25.0, 1e-9);
  EXPECT_NEAR(times[118], 99 / 25.0, 1e-9);
  // A lamp has a period of its own; and what moves by fits and starts has none.
  for (int k = 0; k < 120; ++k) light[k] = 100.0 + 3.0 * std::sin(2.0 * kPi * k / 6.0);
  EXPECT_DOUBLE_EQ(find_repeats(change, light).frames_each, 1.0);
  for (double& c : change) c = random.uniform(0.2, 1.3);
  EXPECT_DOUBLE_EQ(find_repeats(change, std::vector<double>(120, 100.0)).frames_each, 1.0);
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

}  // namespace
}  // namespace unseen::collision::test
