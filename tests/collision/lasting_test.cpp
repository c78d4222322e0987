// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/lasting.h"

#include <gtest/gtest.h>

#include "collision/video/background.h"
#include "little_videos.h"

namespace unseen::collision::test {
namespace {

/// Largest mean difference of a channel within `patch`.
double mean_off(const cv::Mat& picture, const cv::Mat& truth, const cv::Mat& patch) {
  cv::Mat difference;
  cv::absdiff(picture, truth, difference);
  const cv::Scalar mean = cv::mean(difference, patch);
  return std::max({mean[0], mean[1], mean[2]});
}

/// A floor of one colour with grain of a few pixels.
cv::Mat marbled() {
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar(118, 129, 141)), grain = cv::Mat::zeros(picture.size(), CV_32F);
  Random random(5);
  for (int y = 0; y < grain.rows; ++y)
    for (int x = 0; x < grain.cols; ++x) grain.at<float>(y, x) = static_cast<float>(120.0 * random.normal());
  cv::GaussianBlur(grain, grain, {0, 0}, 2.5);
  for (int y = 0; y < grain.rows; ++y)
    for (int x = 0; x < grain.cols; ++x)
      for (int c = 0; c < 3; ++c) picture.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<unsigned char>(picture.at<cv::Vec3b>(y, x)[c] + grain.at<float>(y, x));
  return picture;
}

/// A printed box tumbles above a floor with texture, on which its shadow lay before: the floor is seen in its light for a fourth of the clip only.
TEST(Lasting, AFloorWithTextureIsFoundUnderABodyAndItsShadow) {
  const cv::Mat floor = marbled();
  const cv::Point middle(160, 120);
  Random random(3);
  std::vector<cv::Mat> frames;
  for (int k = 0; k < 48; ++k) {
    cv::Mat frame = floor.clone();
    if (k < 18) {
      cv::Mat dark;
      frame.convertTo(dark, CV_8UC3, 0.65);
      cv::Mat mask = cv::Mat::zeros(frame.size(), CV_8U);
      cv::ellipse(mask, middle, {26, 12}, 0, 0, 360, cv::Scalar(255), cv::FILLED);
      dark.copyTo(frame, mask);
    } else if (k >= 30) {
      cv::RNG print(static_cast<std::uint64_t>(k));
      cv::rectangle(frame, middle - cv::Point(24, 30), middle + cv::Point(24, 30), cv::Scalar(40, 200, 220), cv::FILLED);
      for (int i = 0; i < 30; ++i) {
        const cv::Point at = middle + cv::Point(print.uniform(-22, 18), print.uniform(-28, 24));
        cv::rectangle(frame, at, at + cv::Point(5, 5), cv::Scalar(print.uniform(20, 60), print.uniform(30, 210), print.uniform(90, 220)), cv::FILLED);
      }
    }
    add_noise(frame, 1.5, random);
    frames.push_back(frame);
  }
  cv::Mat patch = cv::Mat::zeros(floor.size(), CV_8U);
  cv::ellipse(patch, middle, {20, 8}, 0, 0, 360, cv::Scalar(255), cv::FILLED);
  EXPECT_LT(mean_off(find_background(frames, Context()).picture, floor, patch), 5.0);
}

}  // namespace
}  // namespace unseen::collision::test
