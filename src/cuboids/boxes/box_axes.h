// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <span>

#include "cuboids/surfaces/faces.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// A face whose normal has less of another direction than this is across it: of up, it is upright.
inline const double kUprightSine = std::sin(radians(15.0));

/// Directions of a box's edges, the third the one closest to up. Free orientation: those of the two largest orthogonal
/// faces. Else up-aligned, with the yaw of the upright faces or of the rectangle of least area around the points, turned
/// to the largest face where that clearly leans; unless the faces that were seen clearly follow the free axes instead.
Mat3 box_axes(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, bool free_orientation);

/// Whether a face is across one of the axes.
bool is_along(const Face& face, const Mat3& axes);
/// Share of the points that lie on faces across one of the axes.
double explained_share(std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes);

}  // namespace unseen::cuboids
