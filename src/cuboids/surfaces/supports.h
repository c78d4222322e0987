// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cuboids/surfaces/levels.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Static surfaces among the faces of a frame, in the camera's coordinates; the first is the ground.
struct FoundSupports {
  Vec3 up = Vec3::UnitY();
  std::vector<Support> supports;  ///< outline empty = without end
  std::vector<std::vector<int>> points;
  bool upside_down = false;  ///< nothing faces the given up, but much its opposite
};

/// Up as the surfaces tell it.
struct FoundUp {
  Vec3 up = Vec3::Zero();  ///< zero = nothing tells
  bool ambiguous = false;  ///< another surface may be the ground as well
};

/// The direction that most large faces agree is up in a picture taken upright or looking down, unless what stands there
/// stands on another large plane: then the camera was turned about its axis, and the normal of that plane is up.
FoundUp find_up(const Scan& scan);

/// Whether a camera with this up was turned about its axis by more than people turn one to take a picture upright.
bool is_turned(const Vec3& up);

/// Ground: the lowest large horizontal surface that carries things. Then, if masks name all things (`unnamed`: the faces are what no
/// mask names), desks: others that carry some; walls that bound what was seen, ceilings. Empty supports if there is no ground.
FoundSupports find_supports(const Scan& scan, const Vec3& up, bool unnamed);

/// The outline of a support in world coordinates as seen from above; empty = without end.
std::vector<Vec2> plan_of(const Support& support);

}  // namespace unseen::cuboids
