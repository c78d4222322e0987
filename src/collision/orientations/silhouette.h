// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "unseen/collision/types.h"

namespace unseen::collision {

inline constexpr int kDirections = 32;

/// How far a plane figure reaches in kDirections evenly spaced directions, from a given origin: its support function, which says
/// everything of a convex figure and is that of the convex hull of any other. Direction i has the angle 2πi/kDirections.
using Support = Eigen::Matrix<double, kDirections, 1>;

/// The directions, one a row.
const Eigen::Matrix<double, kDirections, 2>& support_directions();

/// Support function of points (one a column) about `origin`.
Support support_of(const Eigen::Matrix2Xd& points, const Vec2& origin);

/// Pixels of `vertices` (one a column, body's axes) of a body at `center` turned by `q`; what is behind the camera is put far off.
Eigen::Matrix2Xd projected(const Eigen::Matrix3Xd& vertices, const Quat& q, const Vec3& center, const Camera& camera);

/// Corners of the convex hull of a mask's pixels (their outer edges), in the mask's own pixels, without spurs thinner than `spur`.
/// Empty if nothing is left.
std::vector<Vec2> mask_outline(const cv::Mat& mask, double spur);

/// Area of a polygon without crossings.
double polygon_area(const std::vector<Vec2>& polygon);

}  // namespace unseen::collision
