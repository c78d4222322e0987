// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/candidates.h"
#include "collision/tracks/curve.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Candidates of successive frames that lie on one parabola and look alike: a stretch of one flight.
struct Arc {
  std::vector<Candidate> points;  ///< at most one a frame, in order
  Curve curve;
  double noise = 0;               ///< px, root mean square about the curve, degrees of freedom counted

  double begin() const { return points.front().u; }
  double end() const { return points.back().u; }
};
constexpr std::size_t kFewestOfArc = 4;  ///< points

/// The arc through points that are in order.
Arc arc_of(std::vector<Candidate> points);

/// Centroid noise in pixels, from third differences of the best continued sequences; at least `least`.
double estimate_noise(const Candidates& candidates, double least);

/// The same, with what silhouettes of anything but spheres add: their centroids wander about the projected centre of mass as they turn.
double silhouette_noise(const Shot& shot, const Candidates& candidates, double noise, Context& context);

/// The arc's looks: those of its middle, with its mean colour and roundness and its typical size.
Candidate looks_of(const Arc& arc);

/// All stretches of flight, longest first, each candidate in at most one or (at the ends) two. Seeds are triples of candidates at
/// equal steps; they grow frame by frame while the next one lies where it should and looks alike (thesis Section 5.3.2 draws them at
/// random). `noise` is what candidates may be off their parabola; `jitter`, if it is much less, what they may be off where their
/// neighbours lead: silhouettes of turning bodies wander, but slowly.
std::vector<Arc> find_arcs(const Candidates& candidates, double noise, double jitter, Context& context);

}  // namespace unseen::collision
