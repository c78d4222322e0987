// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace unseen::collision {

/// Motion of a hand-held camera against the background, frame by frame: corners tracked from the first frame (Shi and Tomasi;
/// pyramidal Lucas–Kanade), a similarity by RANSAC, so that movers take no part.
class Stabiliser {
 public:
  /// Takes the next frame, 8-bit grey. `usable` is false for a black frame, which is passed over.
  void add(const cv::Mat& gray, bool usable);

  struct Motion {
    std::vector<cv::Mat> shift;  ///< 2×3, frame to the first frame; empty if the camera stood still
    double largest = 0;          ///< px, of a corner of the picture
    double lost = 0;             ///< share of the frames whose motion could not be found
  };
  /// What was found, in pixels `scale` times those of the frames that were added.
  Motion finish(double scale) const;

 private:
  cv::Mat register_frame(const cv::Mat& gray);

  cv::Mat first_;
  std::vector<cv::Point2f> corners_, places_;
  std::vector<cv::Mat> shifts_;
  int tried_ = 0, lost_ = 0;
  double before_ = 0, after_ = 0;  ///< summed differences from the first frame without and with the motion undone
};

}  // namespace unseen::collision
