// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>

#include "interactions/layout/gather_objects.h"

namespace unseen::interactions {

/// Somebody's hips and knees in a frame, and which objects they use then (ids): those they may be inside of.
struct Passing {
  std::array<Vec3, 3> joints;  ///< pelvis, right knee, left knee
  std::vector<int> uses;
};

/// What it costs that an object stands where it stands, moved by `shift`: the way from where it was found, overlap with others (thesis Eq. 6.11; of
/// whatever category and heading, for those that agree are one by now), and the squared depth of people inside it (Eq. 6.12; tables only against
/// the pelvis).
double standing_cost(const Object& object, const Vec2& shift, std::span<const FoundObject> others, std::span<const Passing> people);

/// Moves objects by at most half a metre to where they stand in nobody's way. What is still inside another at the end, and less sure, goes.
void settle_objects(std::vector<FoundObject>& objects, std::span<const Passing> people);

}  // namespace unseen::interactions
