// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"

namespace unseen::cuboids {

/// m: σ of the depth at 1 m, as given by the options; else as measured on the flattest patches of the depth image, and at most that of a Kinect
/// (0.0015), which is also taken for fused clouds, for what has no such patches, and for depth that was smoothed and so hides its noise, unless even
/// what is left is more, as a stereo camera's. Depth in steps
/// is as uncertain as these are wide.
double depth_noise(const RgbdFrame& frame, const Options& options);

/// The same options with that noise; a warning tells of depth in coarse steps.
Options with_depth_noise(const RgbdFrame& frame, Options options, Context& context);

}  // namespace unseen::cuboids
