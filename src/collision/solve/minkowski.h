// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/contact.h"

namespace unseen::collision {

/// Of two polytopes: the faces of either, and where an edge of one meets an edge of the other, which is where their arcs on the
/// Gauss map cross (Gregorius, GDC 2013). A sphere counts as its centre.
std::vector<MinkowskiFace> minkowski_faces(const Hull& a, const Quat& q_a, const Hull& b, const Quat& q_b);

/// Of a sphere's centre and the corners and edges of a polytope (or of another sphere's centre) with the centres `apart` (m, from b to a):
/// there the difference is round.
std::vector<MinkowskiFace> round_faces(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b, const Vec3& apart);

}  // namespace unseen::collision
