// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/planes/types.h"

namespace unseen::planes {

/// Adds the distances between those of some parallel planes that face each other: of which one sees the other, along their normal, from much of its
/// area with none of the planes between. `planes` are in the order of their offsets, `u` and `v` lie in all of them.
void find_distances(const std::vector<int>& planes, const Vec3& u, const Vec3& v, Arrangement& result);

}  // namespace unseen::planes
