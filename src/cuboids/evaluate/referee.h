// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <utility>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Boxes as a physics engine gets them. Only the fixed contacts are told; it finds the others by itself.
struct RefereeScene {
  std::vector<Support> supports;
  std::vector<OrientedBox> boxes;
  std::vector<double> masses;                ///< kg, of each box
  std::vector<std::pair<int, int>> fixed;    ///< indices of boxes; −1 = a support
  double friction = 0.7;
};

/// The rigid body that each box belongs to: the lowest index of those fixed together; −1 = fixed to a support, and cannot move.
std::vector<int> bodies_of(const RefereeScene& scene);

/// True if this build has the engine.
bool has_referee();

/// Lets MuJoCo run for `seconds` with gravity along `down` (in g). Gives for each box the largest distance that a corner
/// of it moved, as a share of its longest side; at least 1 if the
/// simulation blows up. Throws std::logic_error without the engine.
std::vector<double> simulate(const RefereeScene& scene, const Vec3& down, double seconds, Context& context);

}  // namespace unseen::cuboids
