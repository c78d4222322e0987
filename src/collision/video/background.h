// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// What the camera sees when nothing moves.
struct Background {
  cv::Mat picture;  ///< 8-bit BGR
  cv::Mat noise;    ///< 32-bit float, grey levels: σ of a pixel's worst channel
};

/// Frames spread evenly over a clip of unknown length, at most a fixed number of them.
class FrameSample {
 public:
  void add(const cv::Mat& frame);
  const std::vector<cv::Mat>& frames() const { return frames_; }
  const std::vector<int>& indices() const { return indices_; }  ///< counted over what was added

 private:
  std::vector<cv::Mat> frames_;
  std::vector<int> indices_;
  int added_ = 0, stride_ = 1;
};

/// Median over the frames, brightness evened out, or the colour that lasts where bodies linger; what rests in one place for longer than
/// it is away is told from the true background by its outline. Noise: 1.4826 · median absolute deviation, smoothed.
Background find_background(const std::vector<cv::Mat>& frames, const Context& context);

/// Factor by which `frame` is brighter than the background, a channel each: what most pixels agree on.
cv::Scalar gain_of(const cv::Mat& frame, const cv::Mat& background);

}  // namespace unseen::collision
