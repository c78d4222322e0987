// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>

#include "collision/synth/synth_body.h"

namespace unseen::collision {

/// Turns two bodies so that they touch in one point with one normal: corner and face, two edges that cross, or a ball and anything.
/// `normal` points from b to a. Fills the orientations and gives each centre relative to the contact, [a, b].
std::array<Vec3, 2> touch(const SynthBody& a, const SynthBody& b, const Vec3& normal, Random& random, Quat& qa, Quat& qb);

/// Turns a body so that one point of it, a corner if it has any, is the foremost in a direction; gives the centre relative to it.
Vec3 show_corner(const SynthBody& body, const Vec3& direction, Random& random, Quat& q);

}  // namespace unseen::collision
