// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/collision/types.h"

namespace unseen::collision {

/// A body's surface about its centre of mass, in the file's axes: the mesh, a box's eight corners, or a sphere of 24 × 48 facets. Empty
/// for what is fixed. Throws InputError, naming `source`, for a mesh that is not closed.
TriangleMesh body_mesh(const Body& body, const std::string& source);

/// The largest extent along the file's axes, m; 0 for what is fixed.
double largest_extent(const Body& body);

}  // namespace unseen::collision
