// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "unseen/core/mesh.h"

namespace unseen::io {

/// Corners that a polygon may have; what has more is no face of a mesh.
inline constexpr std::size_t kMostCorners = 1000;

/// Cuts a polygon, which may have dents, into triangles and appends them; corners must index mesh.vertices.
void append_polygon(const std::vector<std::uint32_t>& corners, TriangleMesh& mesh);

}  // namespace unseen::io
