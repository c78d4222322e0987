// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/video/background.h"
#include "collision/video/regions.h"

namespace unseen::collision {

/// Marks the regions that something before the scene covers in part (Region::covered, Region::clipped): a good part of their outline runs along an edge of
/// the background beyond which nothing that moves is ever seen. The background's pixel (0, 0) lies at `corner` of the decoded frame, and
/// is `scale` of its pixels wide. Does nothing where the camera moved.
void mark_covered(const Background& background, cv::Point corner, int scale, Footage& footage, const Context& context);

}  // namespace unseen::collision
