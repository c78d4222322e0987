// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>

#include "collision/video/background.h"
#include "collision/video/regions.h"

namespace unseen::collision {

/// What of a part could be the background with less light.
struct Shade {
  cv::Mat mask;                         ///< 8 bit, of the part's box
  bool whole = false;                   ///< nearly all of the part
  ShadowSign sign = ShadowSign::light;  ///< of most of it
};

/// The shadow in the pixels of `mask`: those of the background's colour (Horprasert et al., 1999), less those that lack its texture and
/// less the shaded sides of a body. `difference`: of frame and background, grey levels; all of one size.
Shade find_shade(const cv::Mat& frame, const Background& background, const cv::Mat& difference, const cv::Mat& mask);

/// How much of the background's texture is seen in the pixels of `mask`: 1 under a shadow, 0 on a body.
struct Texture {
  double seen = 0;       ///< share of the background's
  double error = 1;      ///< σ of the share
  double strength = 0;   ///< of the background's texture in this light, grey levels; what is weak is lost in compression
};
Texture texture_in(const cv::Mat& frame, const cv::Mat& background, const cv::Mat& mask);

}  // namespace unseen::collision
