// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cuboids/faces.h"
#include "cuboids/observation.h"

namespace unseen::cuboids {

/// Directions of a box's edges and how sure its turn is.
struct BoxAxes {
  Mat3 axes = Mat3::Identity();
  double yaw_information = 0;  ///< 1/rad²
};

/// Up-aligned: yaw from the upright faces, or from the rectangle of least area around the points; slanted: the two
/// largest orthogonal faces. The third axis is the one closest to up.
BoxAxes box_axes(const Observation& seen, std::span<const int> points, std::span<const Face* const> faces, bool free_orientation);

/// Whether the largest face leans neither upright nor flat, and clearly so.
bool is_slanted(const Observation& seen, std::span<const int> points, std::span<const Face* const> faces);

/// The box with the given axes around what was seen: sides where a face was seen by the face's mean, the others where
/// the points end (median over slices), at least a voxel thick away from the viewpoint.
OrientedBox bound(const Observation& seen, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                  double voxel);

}  // namespace unseen::cuboids
