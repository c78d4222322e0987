// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <functional>
#include <optional>

#include "collision/solve/contact.h"
#include "collision/tracks/candidates.h"

namespace unseen::collision {

constexpr std::size_t kFewestSeen = 4;        // sightings of a flight
constexpr std::size_t kFewestSeenOfPair = 3;  // the same where both bodies change at one time

/// Noise (px) of sightings of some bodies, each in order of time, from their third differences, which no flight has; at least `least`.
double sighting_noise(const std::vector<std::vector<Candidate>>& bodies, double least);

/// Adds a flight of sightings `[begin, end)`.
void add_flight(const std::vector<Candidate>& seen, std::size_t begin, std::size_t end, int body, double fps, Tracks& tracks);

/// Flights in space through some of the sightings of one or two bodies, each in order of time.
class Flights {
 public:
  Flights(const Shot& shot, const ShotCamera& camera, double noise);

  /// ½ χ² (robust) of sightings `[begin, end)` of each body about flights that change at frame time `u`; without `u` nothing changes.
  std::optional<double> cost(const std::vector<std::vector<Candidate>>& bodies, std::size_t begin, std::size_t end, std::optional<double> u, double fps) const;

  /// Whether the shot tells which way is down.
  bool knows_down() const { return given_; }
  void set_down(const Vec3& down) { shot_.down = down; }

  /// ½ χ² of down, which is near the picture's where the shot does not give it.
  double cost_of_down() const;

  /// Takes down so that `cost` and its own cost are least, if the shot does not give it; what they are then.
  std::optional<double> settle_down(const std::function<std::optional<double>()>& cost);

 private:
  Shot shot_;
  ShotCamera camera_;
  bool given_;  ///< down, by the shot
  std::array<Solid, 2> solids_;
  double noise_;
};

}  // namespace unseen::collision
