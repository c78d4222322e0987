// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// Mends a median picture (8-bit BGR) and the median absolute `deviation` from it where something covers the background for about half
/// of the clip, such as a body near the top of its flight: there the colour counts that most frames agree on, those far apart in time
/// more than neighbours, for the background comes back while a body turns and moves on.
void restore_lasting(const std::vector<cv::Mat>& frames, cv::Mat& picture, cv::Mat& deviation, const Context& context);

}  // namespace unseen::collision
