// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/tracks/candidates.h"
#include "collision/tracks/curve.h"
#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// The flight's curve near one of its ends, from no more of its points than one parabola explains: drag and perspective bend long ones.
Curve curve_near_end(const std::vector<Candidate>& points, double noise);
Curve curve_near_begin(const std::vector<Candidate>& points, double noise);

constexpr double kBeyond = 0.75;  ///< frame times that an impact may lie within the flights that it parts

/// Two flights of one body at the instant that is to lie between them.
struct Joint {
  double u = 0;          ///< frame times
  double apart = 0;      ///< px between the extrapolations
  double spread = 0;     ///< px, standard deviation of that by noise and extrapolation
  double tolerance = 0;  ///< px that this and the body's looks explain
  Vec2 change = Vec2::Zero();  ///< of velocity, px a frame time
  bool sudden = false;   ///< the change is more than noise: an impact
};

Joint joint_at(double u, const Curve& before, const Curve& after, double noise, double diameter);

/// The same where they come closest to one another. `end` and `begin` are the times of the last sighting before and the first after.
Joint join(const Curve& before, double end, const Curve& after, double begin, double noise, double diameter);

/// True if the change of velocity could be a push by something that the body flew into, and flew away from.
bool rebounds(const Curve& before, const Curve& after, const Joint& joint);

/// The argument from `low` to `high` at which `cost` is least: the best of many steps, refined.
template <class Cost>
double least_between(double low, double high, const Cost& cost) {
  constexpr int kSteps = 400, kRounds = 20;
  double best = low, least = cost(low);
  const auto look = [&](double u) {
    if (const double c = cost(u); c < least) least = c, best = u;
  };
  for (int i = 1; i <= kSteps; ++i) look(low + (high - low) * i / kSteps);
  double step = (high - low) / kSteps;
  for (int round = 0; round < kRounds; ++round, step *= 0.5)
    for (const double u : {best - step, best + step})
      if (u >= low && u <= high) look(u);
  return best;
}

/// Appends a flight of `body` to the tracks.
void add_span(Tracks& tracks, int body, const std::vector<Candidate>& points, double fps);

/// Robust σ about the curves, a coordinate, px, degrees of freedom counted. At least 0.05.
double noise_about(const std::vector<std::vector<Candidate>>& flights, const std::vector<Curve>& curves);

}  // namespace unseen::collision
