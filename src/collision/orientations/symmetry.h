// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "unseen/collision/types.h"

namespace unseen::collision {

/// Rigid maps of a convex body (corners about its centre of mass) onto itself, within `tolerance` of its reach.
struct Symmetry {
  std::vector<Quat> turns;         ///< rotations; the identity first
  std::vector<Mat3> reflections;   ///< determinant −1
};

Symmetry symmetry_of(const std::vector<Vec3>& corners, double tolerance = 0.01);

/// Rotations that map the body nearly onto itself, one of each kind that the symmetry's own turns leave apart.
std::vector<Quat> near_turns(const std::vector<Vec3>& corners, const Symmetry& symmetry);

/// How much two sides of a box differ, as a share, where that is so little that outlines hardly tell them apart; nothing for other shapes, for
/// sides that are the same, and where all differ clearly.
std::optional<double> nearly_alike_sides(const Body& body);

/// The least rotation, rad, after which a body of these corners looks so nearly as before that outlines hardly tell; nothing where all do.
std::optional<double> nearly_alike_turn(const std::vector<Vec3>& corners);

/// The member g of `turns` for which q·g is nearest to `to`, as q·g.
Quat nearest_alike(const Quat& q, const Quat& to, const std::vector<Quat>& turns);

/// Angle between two orientations of a body with these symmetries, rad.
double angle_between(const Quat& a, const Quat& b, const std::vector<Quat>& turns);

}  // namespace unseen::collision
