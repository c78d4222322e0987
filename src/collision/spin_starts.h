// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/problem.h"

namespace unseen::collision {

/// How a torque-free body may have turned on one side of the impact: orientation and unit-mass momentum at the impact.
struct SpinGuess {
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero();
  Mat3 spread = Mat3::Zero();  ///< covariance of h
  double cost = 0;  ///< ½ χ² of the orientations
};

/// Rotations that join the orientations of a body on one side of the impact, with several numbers of whole turns between them; the best
/// first. With one orientation: at rest. With none: nothing.
std::vector<SpinGuess> spin_guesses(const Problem& problem, int body, bool after, double time);

}  // namespace unseen::collision
