// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

/// What each of the 15 poses counts in the squared distance of motions: a Gaussian around the middle, sum 1.
Eigen::Matrix<float, kDescriptorPoses, 1> pose_weights();

}  // namespace unseen::interactions
