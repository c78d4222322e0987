// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"

namespace unseen::cuboids {

/// The frame with sharp edges, if its depth is smeared across them, as a phone fills in and smooths what its lidar measures: what lies between two
/// surfaces is continued from the one that it is nearer to, and a warning says so. Nothing for other depth images and for clouds.
std::optional<RgbdFrame> without_smear(const RgbdFrame& frame, Context& context);

}  // namespace unseen::cuboids
