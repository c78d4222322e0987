// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "cuboids/surfaces/levels.h"

namespace unseen::cuboids {

/// Whether much of where a surface ends is the picture's border, and beside all of the rest lies what hides it: then it goes on there.
/// False for a fused cloud.
bool goes_on_beyond_picture(const Scan& scan, const Level& level);

}  // namespace unseen::cuboids
