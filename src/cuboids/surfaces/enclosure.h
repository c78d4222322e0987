// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/surfaces/levels.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A wall or a ceiling.
struct Enclosing {
  SupportKind kind = SupportKind::wall;
  Level level;
  std::vector<Vec3> outline;  ///< a wall's goes down to the ground
};

/// What bounds the scene among its upright faces and those that face down, given by their indices.
std::vector<Enclosing> find_enclosure(const Scan& scan, const std::vector<int>& upright, const std::vector<int>& downward, const Plane& ground);

}  // namespace unseen::cuboids
