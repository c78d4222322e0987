// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/resting.h"

#include <gtest/gtest.h>

#include "collision/tracks/candidates.h"
#include "collision/video/regions.h"
#include "little_videos.h"

namespace unseen::collision::test {
namespace {

constexpr double kRadius = 20.0;  // px
constexpr int kHit = 22;          // frame, of 48

// A ball lies on a post until another hits it, and is slow to leave: for half of the clip its colour is where it was, and its background is not what most frames agree on.
TEST(Resting, ABallOnAPostIsSeenWholeUntilItIsHit) {
  const Scratch scratch("post");
  const std::string path = scratch.file("post.avi");
  const auto hit = [](int k) { return Vec2(160.0 + 6.0 * std::max(0, k - kHit), 100.0 + 0.06 * std::pow(std::max(0, k - kHit), 2)); };
  const auto striker = [](int k) { return Vec2(k < kHit ? 120.0 - 5.5 * (kHit - k) : 120.0 + 1.5 * (k - kHit), 105.0 + (k < kHit ? 0.0 : 0.2 * std::pow(k - kHit, 2))); };
  Random random(4);
  write_video(path, 48, [&](int k) {
    cv::Mat frame(kHeight, kWidth, CV_8UC3, cv::Scalar(98, 112, 104));
    cv::rectangle(frame, {145, 120}, {175, kHeight}, cv::Scalar(30, 45, 70), cv::FILLED);
    draw_disc(frame, hit(k), kRadius, cv::Scalar(150, 80, 35));
    draw_disc(frame, striker(k), kRadius, cv::Scalar(40, 50, 165));
    add_noise(frame, 1.5, random);
    return frame;
  });
  Shot shot;
  shot.video = path;
  shot.fps = 60;
  Context context;
  const Footage footage = find_regions(shot, context);
  ShotCamera camera;
  camera.camera = {400, 400, 160, 120, kWidth, kHeight};
  const Candidates candidates = candidates_of(footage, camera, true);
  int whole = 0;
  for (int k = 1; k + 1 < kHit; ++k) {
    const auto& frame = candidates[static_cast<std::size_t>(k)];
    const auto ball = std::find_if(frame.begin(), frame.end(), [&](const Candidate& c) { return (c.pixel - hit(k)).norm() < 2.0; });
    ASSERT_NE(ball, frame.end()) << k;
    EXPECT_NEAR(ball->diameter, 2.0 * kRadius, 0.05 * 2.0 * kRadius) << k;
    whole += ball->whole;
  }
  EXPECT_GE(whole, 18);  // of 20
}

}  // namespace
}  // namespace unseen::collision::test
