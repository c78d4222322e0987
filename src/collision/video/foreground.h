// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "collision/video/background.h"
#include "collision/video/regions.h"

namespace unseen::collision {

/// A part of a frame that differs from the background, in the pixels of what was compared.
struct Part {
  cv::Rect box;
  cv::Mat mask;         ///< 8 bit, of `box`
  bool shadow = false;  ///< all of it could be the background with less light
  ShadowSign sign = ShadowSign::light;
  double dimmed = 0;    ///< share that was cut off as a shadow for being darker than the background alone
};

/// Parts of a frame where it differs from the background (already brought to the frame's brightness and place) by more than the noise:
/// low threshold where it is joined to a high one, attached shadows cut off, outline where the
/// local contrast halves. `edge_slack`: px by which the background may be out of place.
std::vector<Part> find_parts(const cv::Mat& frame, const Background& background, double edge_slack);

/// Centroid, size, colour of a part of `frame`. Pixels of the decoded frame are `scale` times as many, `offset` further.
Region describe_part(const Part& part, const cv::Mat& frame, int index, int scale, cv::Point offset);

}  // namespace unseen::collision
