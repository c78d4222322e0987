// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// Takes out of a median picture what rests in one place for most of a clip, such as a ball that is held at first, lies still at the
/// end, or is there until another hits it: colours that came or went once, whose border stands out from its surroundings, and what is behind them
/// does not, as far as some frames show it.
void remove_resting(const std::vector<cv::Mat>& frames, const cv::Mat& noise, cv::Mat& picture, const Context& context);

}  // namespace unseen::collision
