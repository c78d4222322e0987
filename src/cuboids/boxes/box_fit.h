// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/surfaces/faces.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// The box with the given axes around what was seen: sides where a face was seen by the face's mean, the others where the points end (nine of ten slices end
/// before; in what leans, slices that lean too), at least a voxel thick (m) away from the viewpoint.
OrientedBox bound(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                  double voxel);

/// m: mean standard deviation of points.
double mean_sigma(const Observation& seen, std::span<const int> points);

constexpr double kNearSurface = 2.0;  // standard deviations: what lies on a side of a box

/// Share of the points that lie on the surface of a box, as near as so many standard deviations.
double share_on_surface(const Observation& seen, std::span<const int> points, const OrientedBox& box, double sigmas);

/// The box around a part of something: along the axes of the `whole`, unless its `own` explain its points better. Slender parts hardly tell theirs.
OrientedBox bound_along(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& own,
                        const Mat3& whole, double voxel);

}  // namespace unseen::cuboids
