// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// Ends (m) of a box along a direction.
struct Span {
  double low, high;
};
Span span_along(const OrientedBox& box, const Vec3& axis);

/// Whether both are of one thin slab: its large faces are those of both, within `tolerance` (m).
bool are_one_slab(const OrientedBox& a, const OrientedBox& b, double tolerance);

/// Whether what was taken for a box is a patch of a slab, as of a table's top between what stands on it: it lies within for the most part.
bool is_patch_of(const OrientedBox& patch, const OrientedBox& slab, double tolerance);

/// Whether a box stands on another but for its bottom, which was put too low, by `depth` (m): what hangs over a table's edge seems to end where this does.
bool stands_too_low(const OrientedBox& box, const OrientedBox& below, double depth, double tolerance);

}  // namespace unseen::cuboids
