// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A ball that a hand catches and throws up again, and one that bounces off the same hand, held still.
#include <gtest/gtest.h>

#include "little_videos.h"
#include "unseen/collision/collision.h"

namespace unseen::collision::test {
namespace {

constexpr double kFps = 60.0, kFall = 600.0, kPixels = 10.0;  // px/s²; radius, px
constexpr double kTop = 40.0, kHand = 150.0;                  // px: where the ball is let go, and where it meets the hand

/// Where the ball is, px from above; `hold`: s.
double height(double t, double hold) {
  const double fall = std::sqrt(2.0 * (kHand - kTop) / kFall), speed = kFall * fall;
  if (t < fall) return kTop + 0.5 * kFall * t * t;
  if (t < fall + hold) return kHand + speed * hold / kPi * std::sin(kPi * (t - fall) / hold);
  const double rise = t - fall - hold;
  return kHand - speed * rise + 0.5 * kFall * rise * rise;
}

std::string warnings(double hold) {
  const Scratch scratch("held");
  Shot shot;
  shot.video = scratch.file("held.avi");
  Random random(4);
  write_video(shot.video, 90, [&](int k) {
    cv::Mat frame(kHeight, kWidth, CV_8UC3, cv::Scalar(118, 124, 120));
    const double y = height(k / kFps, hold), hand = hold > 0.0 && y > kHand ? y : kHand;
    cv::rectangle(frame, cv::Rect(150, static_cast<int>(std::lround(hand + kPixels)), 90, 14), cv::Scalar(120, 150, 215), cv::FILLED);
    draw_disc(frame, Vec2(160.0 + 0.3 * k, y), kPixels, cv::Scalar(35, 45, 190));
    add_noise(frame, 1.5, random);
    return frame;
  });
  shot.fps = kFps;
  shot.camera.camera = {400, 400, 160, 120, kWidth, kHeight};
  shot.bodies.resize(2);
  shot.bodies[0].name = "ball", shot.bodies[1].name = "floor";
  shot.bodies[0].radius = kPixels * shot.gravity / kFall;
  shot.bodies[1].shape = Shape::fixed;
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_FALSE(r.impacts.empty());
  std::string all;
  for (const std::string& warning : r.summary.warnings) all += warning + "\n";
  return all;
}

TEST(Held, ABallThatWasHeldIsSaid) {
  EXPECT_NE(warnings(0.25).find("ball was seen as one with something else that moves for 0.2"), std::string::npos);
  EXPECT_EQ(warnings(0.0).find("seen as one"), std::string::npos);
}

}  // namespace
}  // namespace unseen::collision::test
