// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// MuJoCo's options, and what a geom has beside its friction for sliding. The last number but one is the time constant of a contact, s: of 360 generated
/// frames 2 do not stand with 4 ms, 5 to 7 with 2, 3, 6 and 8 ms (chairs and walls whose faces coincide).
inline constexpr const char* kMujocoOptions = R"(timestep="0.001" cone="elliptic" impratio="20" solver="Newton" noslip_iterations="5")";
inline constexpr const char* kMujocoContact = R"(0.005 0.0001" solref="0.004 1")";

/// m: half size of a box as MuJoCo is given it, 0.1 mm smaller: faces that coincide exactly give MuJoCo 2.2 contacts of depth −0.6 m.
Vec3 half_size_for_mujoco(const OrientedBox& box);

/// A slab of 2 cm behind a plane, as large as a polygon on it (at least three points, m) that is as wide as its first side has it.
OrientedBox slab_behind(const Plane& plane, const std::vector<Vec3>& polygon);

/// Whether a support goes on behind what hides it, as a half space: one without outline, and the ground (the first) with nothing below it.
/// Others end at their outline, for there may be things beside a wall and under a desk.
bool is_half_space(std::span<const Support> supports, std::size_t support, std::span<const OrientedBox> boxes);

}  // namespace unseen::cuboids
