// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/surfaces/faces.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Upright faces, those that lie on one upright plane as one: noise breaks a side into many faces, each of which is turned a little. Of each side the
/// plane, which is exactly upright, the centre and the points are given. What is but a few pixels wide is left out: the sliver of a top that is seen along
/// itself may lie in any plane through its row of pixels.
std::vector<Face> upright_sides(const Observation& seen, std::span<const Face* const> faces);

}  // namespace unseen::cuboids
