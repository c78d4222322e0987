// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/foreground.h"

#include <gtest/gtest.h>

#include "little_videos.h"

namespace unseen::collision::test {
namespace {

/// The one part of a picture with a ball at (100, 100), radius 20 px, and a strip of another colour that hangs on it.
Part ball_with_strip(int width, const cv::Scalar& color) {
  const Background background{cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(120, 130, 140)), cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(1.2))};
  cv::Mat frame = background.picture.clone();
  cv::line(frame, {100, 100}, {170, 150}, color, width);
  draw_disc(frame, {100, 100}, 20.0, cv::Scalar(60, 60, 220));
  Random random(2);
  add_noise(frame, 1.0, random);
  const std::vector<Part> parts = find_parts(frame, background, 0.0);
  EXPECT_EQ(parts.size(), 1u);
  return parts.empty() ? Part{} : parts[0];
}

TEST(Foreground, WhatHangsOnABodyAndHardlyShowsIsCutOff) {
  const double ball = kPi * 20.0 * 20.0;
  EXPECT_NEAR(cv::countNonZero(ball_with_strip(7, cv::Scalar(130, 118, 140)).mask), ball, 0.1 * ball);
  EXPECT_GT(cv::countNonZero(ball_with_strip(7, cv::Scalar(60, 60, 220)).mask), 1.25 * ball);   // a handle of its colour
  EXPECT_GT(cv::countNonZero(ball_with_strip(30, cv::Scalar(130, 118, 140)).mask), 1.5 * ball);  // a side of it
}

}  // namespace
}  // namespace unseen::collision::test
