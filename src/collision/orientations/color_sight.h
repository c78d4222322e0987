// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/orientations/pose_cost.h"

namespace unseen::collision {

inline constexpr int kLights = 8;
using Color = Eigen::Vector3d;                     ///< logarithms of the levels
using Light = Eigen::Matrix<double, kLights, 1>;

/// Spherical harmonics of first and second order of a unit normal, without their constants.
Light light_basis(const Vec3& normal);

/// Whether a place is seen well: its normal is not far across the view ray. Camera coordinates.
bool faces_camera(const Vec3& place, const Vec3& normal);

/// The picture's colour at a pixel of the video, bilinear; false outside.
bool color_at(const Look& look, const Vec2& pixel, Color& color);

}  // namespace unseen::collision
