// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>

namespace unseen::collision {

/// A round structuring element `size` pixels wide.
cv::Mat disc(int size);

/// The convex hull of a mask that is not empty.
cv::Mat hull_of(const cv::Mat& mask);

/// Share of its convex hull that a mask fills; 0 if it is empty.
double solidity(const cv::Mat& mask);

/// Share of its bounding circle that a mask fills; 0 if it is empty.
double roundness(const cv::Mat& mask);

/// The pieces of a mask but for crumbs (less than a tenth of the largest), which the rim of a shadow leaves.
cv::Mat without_crumbs(const cv::Mat& mask);

}  // namespace unseen::collision
