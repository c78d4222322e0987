// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Attributes of MuJoCo's `option`.
inline constexpr const char* kMujocoOptions = R"(timestep="0.001" cone="elliptic" impratio="20" solver="Newton" noslip_iterations="5")";

/// Attributes of every `geom`: friction for sliding, spinning and rolling; a contact's time constant (s) and damping; and how firm it is, less in the first half
/// millimetre. So boxes rest some 0.02 mm deep, where fewer faces count as coincident, and stacks do not creep. Measured: docs/cuboids.md.
std::string mujoco_contact(double friction);

/// m: half size of a box as MuJoCo is given it. Faces that coincide exactly give MuJoCo 2.2 contacts of depth −0.6 m, also where a box has just come down
/// onto another: 0.1 mm smaller across, and as much larger upright.
Vec3 half_size_for_mujoco(const OrientedBox& box);

/// A slab of 2 cm behind a plane, as large as a polygon on it (at least three points, m) that is as wide as its first side has it.
OrientedBox slab_behind(const Plane& plane, const std::vector<Vec3>& polygon);

/// Whether a support goes on behind what hides it, as a half space: one without outline, and the ground (the first) with nothing below it.
/// Others end at their outline, for there may be things beside a wall and under a desk.
bool is_half_space(std::span<const Support> supports, std::size_t support, std::span<const OrientedBox> boxes);

}  // namespace unseen::cuboids
