// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>

#include <vector>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// How a torque-free body may have turned on one side of the impact: orientation and unit-mass momentum at the impact.
struct SpinGuess {
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero();
  Mat3 spread = Mat3::Zero();  ///< covariance of h
  double cost = 0;  ///< ½ χ² of the orientations
  bool open = false;  ///< between the orientations the body may have turned a whole time, about any axis
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of the turn of q (rad) and of h, where `open`
};

/// Rotations that join the orientations of a body on one side of the impact, with several numbers of whole turns between them; the best
/// first. With one orientation: at rest. With none: nothing.
std::vector<SpinGuess> spin_guesses(const Problem& problem, int body, bool after, double time);

/// Whether a body may have turned a whole time between any two orientations on one side of the impact, and how many those are.
struct OpenTurns {
  bool open = false;
  int orientations = 0;
};
OpenTurns open_turns(const Problem& problem, int body, bool after);

}  // namespace unseen::collision
