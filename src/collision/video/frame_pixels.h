// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "collision/video/regions.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// Pixels of a decoded frame as pixels of the tracks: without distortion, then moved to the first frame's place.
void to_track_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage);

/// The way back.
void to_frame_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage);

}  // namespace unseen::collision
