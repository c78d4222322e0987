// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/flight_search.h"

#include <algorithm>

#include "collision/tracks/flight_cost.h"

namespace unseen::collision {
namespace {

constexpr double kWellExplained = 2.0;  // ½ χ² a sighting, 1 in the mean

/// An impact, by its frame time, and what flights that change there cost.
struct Turn {
  double u, cost;
};

/// The impact between flights that explains all sightings best, at any frame time: first in steps of a small part of the shot, then in finer ones.
std::optional<Turn> best_turn(Flights& flights, const std::vector<std::vector<Candidate>>& bodies, std::size_t count, double fps, Context& context) {
  constexpr double kFinest = 0.25;   // frames
  constexpr double kCoarsest = 150;  // steps in the shot
  constexpr double kFiner = 4;
  std::optional<Turn> best;
  double from = bodies[0].front().u, to = bodies[0].back().u, step = std::max(kFinest, (to - from) / kCoarsest);
  while (true) {
    for (double u = from; u < to; u += step) {
      context.check();
      const std::optional<double> cost = flights.cost(bodies, 0, count, u, fps);
      if (cost && (!best || *cost < best->cost)) best = Turn{u, *cost};
    }
    if (!best || step == kFinest) return best;
    from = std::max(from, best->u - step);
    to = std::min(to, best->u + step);
    step = std::max(kFinest, step / kFiner);
  }
}

/// The same, and down with it.
std::optional<Turn> find_turn(Flights flights, const std::vector<std::vector<Candidate>>& bodies, std::size_t count, double fps, Context& context) {
  constexpr int kRounds = 4;
  constexpr double kLess = 0.5;  // ½ χ² that a round must gain
  std::optional<Turn> best;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<Turn> now = best_turn(flights, bodies, count, fps, context);
    if (!now) break;
    if (const auto settled = flights.settle_down([&] { return flights.cost(bodies, 0, count, now->u, fps); })) now->cost = *settled;
    if (best && now->cost > best->cost - kLess) break;
    best = now;
  }
  return best;
}

}  // namespace

std::optional<Tracks> search_pair(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, double fps, double least_noise, Context& context) {
  constexpr double kSignificant = 12.0;  // ½ χ² that an impact must explain
  for (const auto& frame : candidates)
    if (std::any_of(frame.begin(), frame.end(), [](const Candidate& c) { return c.body < 0; })) return std::nullopt;
  const std::vector<std::vector<Candidate>> bodies = {sightings_of(candidates, 0), sightings_of(candidates, 1)};
  if (bodies[0].size() < kFewestSeenOfPair + kFewestSeen || bodies[1].size() < kFewestSeenOfPair + kFewestSeen) return std::nullopt;
  const std::size_t count = std::max(bodies[0].size(), bodies[1].size());
  const Flights level(shot, camera, sighting_noise(bodies, least_noise));
  Flights still = level;  // a wrong down bends flights, which an impact would explain
  const std::optional<double> none = still.settle_down([&] { return still.cost(bodies, 0, count, std::nullopt, fps); });
  std::optional<Turn> turn = find_turn(level, bodies, count, fps, context);
  if (const auto other = find_turn(still, bodies, count, fps, context); other && (!turn || other->cost < turn->cost)) turn = other;
  if (!turn || turn->cost > kWellExplained * static_cast<double>(bodies[0].size() + bodies[1].size()) || (none && *none < turn->cost + kSignificant)) return std::nullopt;
  Tracks tracks;
  tracks.noise = sighting_noise(bodies, least_noise);
  Tracks::Meeting meeting{turn->u / fps, {}, {}};
  for (int body = 0; body < 2; ++body) {
    const auto& seen = bodies[static_cast<std::size_t>(body)];
    const auto split = static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), turn->u, [](const Candidate& c, double t) { return c.u < t; }) - seen.begin());
    meeting.before.push_back(static_cast<int>(tracks.spans.size()));
    add_flight(seen, 0, split, body, fps, tracks);
    meeting.after.push_back(static_cast<int>(tracks.spans.size()));
    add_flight(seen, split, seen.size(), body, fps, tracks);
  }
  tracks.meetings = {meeting};
  tracks.collisions_seen = 1;
  return tracks;
}

}  // namespace unseen::collision
