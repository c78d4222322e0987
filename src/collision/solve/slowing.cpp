// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/slowing.h"

#include <algorithm>
#include <array>
#include <map>

#include "collision/solve/shared_value.h"
#include "collision/solve/solve.h"

namespace unseen::collision {
namespace {

constexpr double kMost = 6.0;         // m/s²: a friction of 0.6
constexpr double kLeast = 0.005;      // m/s²: what is tried first
constexpr double kFewestPixels = 10;  // of a flight's way: less tells of no slowing

std::vector<SolvedImpact> with_slowing(std::vector<SolvedImpact> impacts, double slowing) {
  for (SolvedImpact& impact : impacts) {
    impact.solution.problem.slowing = slowing;
    impact.solution.fit = settle(impact.solution.problem, impact.solution.fit.state);
  }
  return impacts;
}

/// What regions that are lopsided, by half of what they may be, bend the longest flight of an impact by, m/s².
double bend_of_lopsided(const Problem& problem) {
  if (!problem.filmed) return 0.0;
  std::map<std::pair<int, bool>, std::array<const PointObservation*, 2>> flights;  // first and last sighting
  for (const PointObservation& p : problem.points) {
    auto& [first, last] = flights.try_emplace({p.body, p.after}, std::array{&p, &p}).first->second;
    if (p.time < first->time) first = &p;
    if (p.time > last->time) last = &p;
  }
  double least = kMost;
  for (const auto& [flight, ends] : flights) {
    const double length = ends[1]->time - ends[0]->time;
    if ((ends[1]->pixel - ends[0]->pixel).norm() < kFewestPixels || length <= 0.0) continue;
    least = std::min(least, 8.0 * 0.5 * kLopsided * problem.solids[static_cast<std::size_t>(flight.first)].mass.extent / (length * length));  // the sagitta of a parabola is 1/8 of that
  }
  return least;
}

}  // namespace

std::vector<SolvedImpact> slowed_by_table(std::vector<SolvedImpact> impacts) {
  std::vector<SolvedImpact> best = std::move(impacts);
  double low = 0.0, high = kLeast, slowing = 0.0;
  for (; high <= kMost; high *= 2.0) {  // step by step, for a flight that is slowed far too much leads astray
    std::vector<SolvedImpact> next = with_slowing(best, high);
    if (!(cost_of(next) < cost_of(best))) break;
    low = slowing, slowing = high, best = std::move(next);
  }
  const SolvedWith with = [&](double value) { return with_slowing(best, value); };
  std::vector<SolvedImpact> finest = with(likeliest_value(with, low, high));
  return cost_of(finest) < cost_of(best) ? finest : best;
}

void add_doubt_of_slowing(const std::vector<SolvedImpact>& impacts, Reconstruction& result) {
  constexpr double kLeastStep = 0.01, kStep = 0.2;  // m/s², and of the slowing
  const Problem& problem = impacts.front().solution.problem;
  if (!problem.planar || problem.drag[0] > 0.0) return;
  double systematic = kMost;
  for (const SolvedImpact& impact : impacts) systematic = std::min(systematic, bend_of_lopsided(impact.solution.problem));
  add_doubt([&](double slowing) { return with_slowing(impacts, slowing); }, {problem.slowing, kMost, kLeastStep + kStep * problem.slowing, systematic}, impacts, result);
}

}  // namespace unseen::collision
