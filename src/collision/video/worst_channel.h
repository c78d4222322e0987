// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace unseen::collision {

/// The largest of each pixel's three channels.
inline cv::Mat worst_channel(const cv::Mat& picture) {
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

/// The largest difference of each pixel's channels.
template <class Other>
cv::Mat worst_difference(const cv::Mat& picture, const Other& other) {
  cv::Mat off;
  cv::absdiff(picture, other, off);
  return worst_channel(off);
}

}  // namespace unseen::collision
