// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace unseen::collision {

/// The largest difference of a channel.
inline double farthest(const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a, b, cv::NORM_INF); }

/// What pixels show in some of the frames beside the colour of a median picture.
struct OtherColors {
  cv::Mat index;  ///< int: of a pixel's `colors`; −1: it has none
  std::vector<std::vector<cv::Vec3b>> colors;
  cv::Mat follow;  ///< 255 where some of them come before or after the median's and not between: something came or went

  std::vector<cv::Vec3b> at(const cv::Point& pixel) const {
    const int i = index.at<int>(pixel);
    return i < 0 ? std::vector<cv::Vec3b>{} : colors[i];
  }
};

OtherColors other_colors(const std::vector<cv::Mat>& frames, const cv::Mat& noise, const cv::Mat& median);

}  // namespace unseen::collision
