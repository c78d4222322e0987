// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/tracks/candidates.h"
#include "collision/tracks/curve.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// A stretch of a track in which the body flies: points [begin, end).
struct Stretch {
  int begin = 0, end = 0;
  Curve curve;
};

/// The image's gravity: curvature of flights, pixels a squared frame time.
struct ImageGravity {
  Vec2 curvature = Vec2::Zero();
  double sigma = 0;  ///< of a flight's curvature about it
};

/// Splits a track into flights and frames that belong to none (held, rolling, at rest, blurred by an impact), with the least cost
/// of all splits (dynamic programme over spans; Bellman, "On the approximation of curves by line segments", 1961). With a gravity,
/// flights are drawn to it, and what is too short to show it is none.
std::vector<Stretch> split_into_flights(const std::vector<Candidate>& track, double noise, const std::optional<ImageGravity>& gravity,
                                        Context& context);

/// The curvature that most of the flights share; none if none of them is clearly curved.
std::optional<ImageGravity> shared_gravity(const std::vector<Stretch>& flights, const std::vector<Candidate>& track, double noise);

/// Takes points off the ends of a flight that the rest of it does not foresee.
void trim(const std::vector<Candidate>& track, double noise, Stretch& flight);

}  // namespace unseen::collision
