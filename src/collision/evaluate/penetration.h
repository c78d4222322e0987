// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/collision/types.h"

namespace unseen::collision {

/// How deep two bodies lie in each other, m; negative: how far they are apart. A mesh counts as its convex hull. Poses are those of the
/// centres of mass, in any one frame. Throws InputError for a mesh that is not closed.
double penetration(const Body& a, const RigidTransform& pose_a, const Body& b, const RigidTransform& pose_b);

/// The same with the half-space behind a plane.
double penetration(const Body& body, const RigidTransform& pose, const Plane& plane);

}  // namespace unseen::collision
