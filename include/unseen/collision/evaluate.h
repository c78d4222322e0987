// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/collision/synth.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// How far one body's motion is from the true one, over the frames that both have.
struct MotionScore {
  std::string name;
  int frames = 0;                  ///< compared
  double trajectory = 0;           ///< root mean square distance of the centres, as a fraction of the body's largest extent
  double depth = 0, across = 0;    ///< the same along the camera's axis and across it
  std::optional<double> rotation;  ///< rad, root mean square, modulo the turns that map the body to itself; none for a ball
};

/// A value against the true one.
struct ValueScore {
  double value = 0, truth = 0;
  double error = 0;      ///< |c − c*|, of the mass ratio |m/m* − 1|
  bool covered = false;  ///< the true value lies in the 95 % interval
};

/// A result against the truth of a simulation. Motions are compared in camera coordinates, so that a wrong vertical does not count twice.
struct Evaluation {
  int impacts = 0, true_impacts = 0, found = 0;  ///< found: true impacts with one of the result nearby
  std::optional<ValueScore> restitution, mass_ratio;
  std::vector<MotionScore> motions;   ///< of what moves
  std::optional<double> time;         ///< frames, mean error of the impacts found
  std::optional<double> penetration;  ///< m, of the true shapes in the result's poses at its first impact
  double gravity = 0;                 ///< rad, between the verticals
};

/// Throws InputError if the bodies have other names, or a mesh is not closed.
Evaluation evaluate(const Reconstruction& result, const Truth& truth);

}  // namespace unseen::collision
