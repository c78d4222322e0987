// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/depth_view.h"
#include "unseen/core/context.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Boxes around what is no box, or around several things, hold space that the camera saw free, or show surface within. `tolerance`: m, a cuboid.
void warn_of_no_boxes(const DepthView& view, const std::vector<double>& tolerance, const std::vector<Cuboid>& cuboids, Context& context);

/// Contacts count within tolerance, but an engine that is given the boxes moves some until they touch. `falls`: a mark a support and a cuboid.
void warn_of_falls(const std::vector<char>& falls, double push, Completion& result, Context& context);

/// What was taken to go on downward, but ends where nothing was measured, may stand on something black or shiny.
void warn_of_unmeasured(const DepthView& view, const std::vector<Cuboid>& cuboids, Context& context);

}  // namespace unseen::cuboids
