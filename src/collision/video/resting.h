// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace unseen::collision {

/// Takes out of a median picture what rests in one place for most of a clip, such as a ball that is held at first or lies still at the
/// end. Where some of the frames agree on a second colour, the one whose border does not stand out from its surroundings is kept.
void remove_resting(const std::vector<cv::Mat>& frames, const cv::Mat& noise, cv::Mat& picture);

}  // namespace unseen::collision
