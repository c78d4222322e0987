// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "cuboids/statics/interface.h"

namespace unseen::cuboids {

/// m: how far a face must move outward until the box meets a body; none if it never does. 0 if they meet already. A body
/// that the swept space only grazes, by less than `tolerance` (m) at its sides, is not met.
std::optional<double> reach(const OrientedBox& box, int face, const ConvexSolid& other, double tolerance);
std::optional<double> reach(const OrientedBox& box, int face, const Support& other);

}  // namespace unseen::cuboids
