// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/faces.h"
#include "cuboids/observation.h"

namespace unseen::cuboids {

/// The box with the given axes around what was seen: sides where a face was seen by the face's mean, the others where the points end (nine of ten slices end
/// before; in what leans, slices that lean too), at least a voxel thick (m) away from the viewpoint.
OrientedBox bound(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes,
                  double voxel);

}  // namespace unseen::cuboids
