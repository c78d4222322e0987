// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/linear_flights.h"
#include "collision/solve/problem.h"
#include "collision/solve/spin_starts.h"
#include "collision/solve/touching.h"

namespace unseen::collision {

/// Two bodies' flights joined by an impact at a given place on both: impulse, mass ratio, positions and velocities that explain centres and
/// momenta best, from equations that are linear but for the mass ratio.
class TouchingFit {
 public:
  /// `base` has the impact's time, its impulse and the mass ratio as the centres alone tell them; the flights are around that time.
  TouchingFit(const Problem& problem, const State& base, const LinearFlight& a, const LinearFlight& b);

  /// A body's momenta before and after, per its own mass, and how well their difference is known.
  struct Turn {
    Vec3 change = Vec3::Zero();
    Mat3 precision = Mat3::Zero();
  };

  struct Result {
    double cost = 0;  ///< ½ χ² above what the flights have apart
    State state;      ///< base with positions, velocities, impulse, mass ratio, time and contact point
  };
  Result operator()(const Touching& touching, const Turn& turn_a, const Turn& turn_b) const;

 private:
  const Problem& problem_;
  const State& base_;
  const LinearFlight &a_, &b_;
  double apart_;  ///< ½ χ² of both flights on their own
};

}  // namespace unseen::collision
