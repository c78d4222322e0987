// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen {

/// Indexed triangles. `labels` is empty or names the surface (e.g. the true plane) of each triangle.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< metres
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> labels;
};

}  // namespace unseen
