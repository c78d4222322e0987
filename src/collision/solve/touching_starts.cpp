// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/touching_starts.h"

#include <algorithm>
#include <cmath>

#include "collision/orientations/views.h"
#include "collision/solve/touching.h"
#include "collision/solve/turnings.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

/// Momenta on both sides that agree with the impulse's lever.
void share_change(const ImpactTurning& turning, const Vec3& change, Vec3& h, Vec3& h_after) {
  h = turning.h, h_after = turning.h + change;
  if (!turning.has_lever) return;
  h -= turning.spread * (turning.spread + turning.spread_after).inverse() * (change - (turning.h_after - turning.h));
  h_after = h + change;
}

/// Directions from the second body's centre to the first's that the flights allow.
std::vector<Vec3> possible_offsets(const Problem& problem, const std::array<LinearFlight, 2>& flights) {
  constexpr int kDirections = 256;
  constexpr double kSlack = 0.1, kFar = 4.0;  // of the bodies' size: what flights hide; standard deviations
  const double size = problem.solids[0].mass.extent + problem.solids[1].mass.extent;
  Mat3 spread = std::pow(kSlack * size, 2) * Mat3::Identity();
  for (const LinearFlight& f : flights) spread += f.normal.topLeftCorner<9, 9>().inverse().topLeftCorner<3, 3>();
  const Mat3 precision = spread.inverse();
  const Vec3 expected = flights[0].p - flights[1].p;
  std::vector<Vec3> possible;
  for (const Vec3& u : sphere_directions(kDirections)) {
    const double along = std::clamp(u.dot(precision * expected) / u.dot(precision * u), 0.0, size);
    const Vec3 off = along * u - expected;
    if (off.dot(precision * off) < kFar * kFar) possible.push_back(u);
  }
  return possible.empty() ? sphere_directions(kDirections) : possible;
}

/// Both shapes known: how well an impact with the centres' offset along a direction explains the flights.
class TouchingStarts {
 public:
  TouchingStarts(const Problem& problem, const State& base, const std::array<LinearFlight, 2>& flights)
      : problem_(problem), fit_(problem, base, flights[0], flights[1]) {}

  Touchings touchings(const TurningPair& pair) const { return {problem_.solids[0], pair.a.q, problem_.solids[1], pair.b.q}; }

  std::optional<Ranked> at(const TurningPair& pair, const Touchings& touchings, const Vec3& direction) const {
    constexpr double kBeyond = 0.1;  // restitution outside [0,1]
    const std::optional<Touching> touching = touchings.along(direction);
    if (!touching) return std::nullopt;
    auto [cost, s] = fit_(*touching, pair.a.turn(), pair.b.turn());
    s.q = {pair.a.q, pair.b.q};
    share_change(pair.a, touching->arm_a.cross(s.impulse), s.h[0], s.h_after[0]);
    share_change(pair.b, Vec3(-touching->arm_b.cross(s.impulse) / s.mass_ratio), s.h[1], s.h_after[1]);
    s.law.emplace();
    s.law->a = touching->normal;
    const double c = restitution<double>(problem_, s, values_of(problem_, s)), beyond = std::max({0.0, -c, c - 1.0}) / kBeyond;
    return Ranked{cost + pair.cost() + 0.5 * beyond * beyond, s};
  }

  /// From there to the best direction nearby.
  Ranked refined(const TurningPair& pair, const Touchings& touchings, Ranked best) const {
    constexpr int kRounds = 16;
    double step = 0.08;  // rad
    for (int round = 0; round < kRounds; ++round) {
      const Vec3 direction = (best.state.p[0] - best.state.p[1]).normalized(), e1 = any_orthogonal(direction), e2 = direction.cross(e1);
      bool better = false;
      for (const Vec3& side : {e1, e2, Vec3(-e1), Vec3(-e2)}) {
        const std::optional<Ranked> next = at(pair, touchings, (direction + step * side).normalized());
        if (next && next->cost < best.cost) best = *next, better = true;
      }
      if (!better) step *= 0.5;
    }
    return best;
  }

 private:
  const Problem& problem_;
  TouchingFit fit_;
};

}  // namespace

std::vector<Ranked> touching_starts(const Problem& problem, const State& base, const std::array<LinearFlight, 2>& flights) {
  constexpr int kTouchings = 4000;   // for all shakes together
  constexpr std::size_t kRefined = 4;  // of each pair of turnings
  const TouchingStarts starts(problem, base, flights);
  const std::vector<Vec3> directions = possible_offsets(problem, flights);
  const int shakes = kTouchings / (2 * static_cast<int>(directions.size()));
  std::vector<Ranked> all;
  for (const TurningPair& pair : turning_pairs(problem, base, shakes)) {
    std::vector<Ranked> some;
    const Touchings touchings = starts.touchings(pair);
    for (const Vec3& direction : directions)
      if (std::optional<Ranked> start = starts.at(pair, touchings, direction)) some.push_back(std::move(*start));
    std::stable_sort(some.begin(), some.end(), [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
    for (std::size_t i = 0; i < std::min(some.size(), kRefined); ++i) all.push_back(starts.refined(pair, touchings, some[i]));
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace unseen::collision
