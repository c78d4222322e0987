// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// The largest difference of a channel.
inline float farthest(const cv::Vec3f& a, const cv::Vec3f& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// What pixels show in some of the frames beside the colour of a median picture.
struct OtherColors {
  static constexpr int kMost = 4;  // colours of a pixel
  cv::Mat count;                   ///< 8 bit: how many colours a pixel has
  std::array<cv::Mat, kMost> colors;
  cv::Mat follow;  ///< 255 where some of them come before or after the median's and not between: something came or went

  std::vector<cv::Vec3b> at(const cv::Point& pixel) const {
    std::vector<cv::Vec3b> shown;
    for (int i = 0; i < count.at<unsigned char>(pixel); ++i) shown.push_back(colors[static_cast<std::size_t>(i)].at<cv::Vec3b>(pixel));
    return shown;
  }
};

/// Colours that enough of the frames show, which are as bright as the median is. `noise`: σ of its pixels, float.
OtherColors other_colors(const std::vector<cv::Mat>& frames, const cv::Mat& noise, const cv::Mat& median, const Context& context);

}  // namespace unseen::collision
