// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/resting.h"

#include <gtest/gtest.h>

#include "collision/tracks/candidates.h"
#include "collision/video/background.h"
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

// A puck waits on marbled ice until another hits it, that then creeps over the place: no colour lasts there, and what is around it does not tell what is behind.
TEST(Resting, APuckOnIceLeavesTheIce) {
  cv::Mat coarse(kHeight / 6, kWidth / 6, CV_8UC3), ice;
  cv::setRNGSeed(3);
  cv::randn(coarse, cv::Scalar(200, 190, 180), cv::Scalar::all(22));
  cv::resize(coarse, ice, {kWidth, kHeight}, 0, 0, cv::INTER_CUBIC);
  cv::line(ice, {0, 118}, {kWidth, 118}, cv::Scalar(160, 95, 70), 6);
  constexpr int kFrames = 48;
  const Vec2 waiting(180, 110);
  Random random(4);
  std::vector<cv::Mat> frames;
  for (int k = 0; k < kFrames; ++k) {
    const int t = k - kHit;
    frames.push_back(ice.clone());
    draw_disc(frames.back(), t < 0 ? waiting : Vec2(waiting.x() + 5.0 * t, waiting.y() - 3.0 * t), kRadius, cv::Scalar(40, 190, 215));
    draw_disc(frames.back(), t < 0 ? Vec2(143.0 + 7.0 * t, 128) : Vec2(143.0 + 1.7 * t, 128.0 + 2.0 * t), kRadius, cv::Scalar(45, 40, 200));
    add_noise(frames.back(), 1.5, random);
  }
  Context context;
  const Background background = find_background(frames, context);
  cv::Mat off, place = cv::Mat::zeros(ice.size(), CV_8U);
  cv::absdiff(background.picture, ice, off);
  cv::circle(place, cv::Point(180, 110), static_cast<int>(kRadius) - 1, cv::Scalar(255), cv::FILLED);
  const cv::Scalar mean = cv::mean(off, place);
  EXPECT_LT(mean[0] + mean[1] + mean[2], 3 * 4.0);
}

}  // namespace
}  // namespace unseen::collision::test
