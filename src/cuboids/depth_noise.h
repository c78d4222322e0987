// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"

namespace unseen::cuboids {

/// m: σ of the depth at 1 m, as given by the options; else as measured on the flattest patches of the depth image, and at most that of a Kinect
/// (0.0015), which is also taken for what has no such patches and for fused clouds.
double depth_noise(const RgbdFrame& frame, const Options& options);

}  // namespace unseen::cuboids
