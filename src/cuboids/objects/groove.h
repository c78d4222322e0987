// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Of each side of a box that looks at the camera, along its line at a place (m from the centre) along an axis: share of what was measured there
/// that is farther than the side. Sides across the axis have no such line; those with too few measurements say nothing.
std::vector<double> seen_through(const DepthView& view, const OrientedBox& box, int axis, double place);

/// Places along an axis where a groove runs across two sides that look at the camera: there are bodies on either side of each. A recess in one side may
/// be a joint.
std::vector<double> grooves(const DepthView& view, const OrientedBox& box, int axis);

/// Points on either side of the grooves that run across a part's box, where both sides have enough points.
std::vector<std::vector<int>> cut_at_grooves(const Observation& seen, const DepthView& view, const std::vector<int>& points, const OrientedBox& box, double fewest);

}  // namespace unseen::cuboids
