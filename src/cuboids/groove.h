// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/depth_view.h"
#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// Of each side of a box that looks at the camera, along its line at a place (m from the centre) along an axis: share of what was measured there
/// that is farther than the side. Sides across the axis have no such line; those with too few measurements say nothing.
std::vector<double> seen_through(const DepthView& view, const OrientedBox& box, int axis, double place);

/// Places along an axis where a groove runs round all sides that look at the camera: there are two bodies, one beside the other.
std::vector<double> grooves(const DepthView& view, const OrientedBox& box, int axis);

}  // namespace unseen::cuboids
