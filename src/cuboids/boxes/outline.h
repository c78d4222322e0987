// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>

#include "cuboids/surfaces/faces.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Which way boxes are turned about up, modulo a quarter: unit vectors at four times the angle, times its information (1/rad²). Sums of these combine
/// what several sides tell.
Vec2 quarter_turn(double angle, double information);

/// What the ends of level faces tell of the turn of a level box, near `yaw` (rad): the straight edges behind which something farther was seen.
Vec2 turn_of_outline(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, double yaw);

/// By how much (tangents) what stands upright leans along the first two of some axes, as both ends of its largest face across do; 0 unless they clearly do,
/// and alike, or the axes are not upright.
Vec2 lean_of_outline(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, const Mat3& axes);

/// Upright axes turned as far as what they are of leans so.
Mat3 leaning_axes(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, const Mat3& axes);

}  // namespace unseen::cuboids
