// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/candidates.h"
#include "collision/curve.h"
#include "collision/tracks.h"

namespace unseen::collision {

/// The flight's curve near one of its ends, from no more of its points than one parabola explains: drag and perspective bend long ones.
Curve curve_near_end(const std::vector<Candidate>& points, double noise);
Curve curve_near_begin(const std::vector<Candidate>& points, double noise);

/// Where two flights of one body come closest to one another in time and place: the instant between them.
struct Joint {
  double u = 0;          ///< frame times
  double apart = 0;      ///< px between the extrapolations
  double tolerance = 0;  ///< px that noise and the extrapolation explain
  Vec2 change = Vec2::Zero();  ///< of velocity, px a frame time
  bool sudden = false;   ///< the change is more than noise: an impact
};

/// `end` and `begin` are the times of the last sighting before and the first after.
Joint join(const Curve& before, double end, const Curve& after, double begin, double noise, double diameter);

/// True if the change of velocity could be a push by something that the body flew into, and flew away from.
bool rebounds(const Curve& before, const Curve& after, const Joint& joint);

/// Appends a flight of `body` to the tracks.
void add_span(Tracks& tracks, int body, const std::vector<Candidate>& points, double fps);

/// Robust σ about the curves, a coordinate, px, degrees of freedom counted. At least 0.05.
double noise_about(const std::vector<std::vector<Candidate>>& flights, const std::vector<Curve>& curves);

}  // namespace unseen::collision
