// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/linear_flights.h"
#include "collision/solve/problem.h"
#include "collision/solve/spin_starts.h"
#include "collision/solve/touching.h"

namespace unseen::collision {

/// Two bodies' flights joined by an impact at a given place on both: impulse, mass ratio, positions and velocities that explain centres and
/// momenta best, from equations that are linear but for the mass ratio. Everything but how both bodies' velocities change is eliminated once.
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
  static constexpr int kFlights = 10;  // place of the first body, velocities of both before, delay
  static constexpr int kChanges = 6;   // of both velocities
  using Flights = Eigen::Matrix<double, kFlights, 1>;
  using Changes = Eigen::Matrix<double, kChanges, 1>;

  /// With the best flights for given changes, ½ χ² = ½ yᵀ normal y − (right + right_of·offset) y + a constant; the offset is that of the centres.
  Flights flights(const Vec3& offset, const Changes& changes) const { return flights_ + flights_of_ * offset - flights_by_ * changes; }
  double cost(const Vec3& offset, const Changes& changes) const;

  const Problem& problem_;
  const State& base_;
  Eigen::Matrix<double, kChanges, kChanges> normal_;
  Changes right_;
  Eigen::Matrix<double, kChanges, 3> right_of_;
  Flights flights_;
  Eigen::Matrix<double, kFlights, 3> flights_of_;
  Eigen::Matrix<double, kFlights, kChanges> flights_by_;
  double constant_;
  Vec3 constant_along_;
  Mat3 constant_across_;
};

}  // namespace unseen::collision
