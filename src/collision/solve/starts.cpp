// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/starts.h"

#include <algorithm>

#include "collision/solve/linear_flights.h"
#include "collision/solve/solve.h"
#include "collision/solve/touching_starts.h"
#include "collision/solve/turnings.h"

namespace unseen::collision {
namespace {

/// Whether two states turn alike and touch in nearly the same way.
bool alike(const State& a, const State& b) {
  constexpr double kSameNormal = 0.2, kSameTurn = 0.2;  // rad
  if (!a.law || !b.law || line_angle(a.law->a, b.law->a) > kSameNormal) return false;
  for (int o = 0; o < 2; ++o)
    if (a.q[o].angularDistance(b.q[o]) > kSameTurn || (a.h[o] - b.h[o]).norm() > 0.2 * (a.h[o].norm() + b.h[o].norm())) return false;
  return true;
}

/// The states of the lowest cost, best first and unlike.
std::vector<State> best_of(std::vector<Ranked> all, int count) {
  std::stable_sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  std::vector<State> states;
  for (const Ranked& r : all) {
    if (static_cast<int>(states.size()) == count) break;
    if (std::none_of(states.begin(), states.end(), [&](const State& s) { return alike(s, r.state); })) states.push_back(r.state);
  }
  for (State& s : states) s.law.reset();
  return states;
}

/// The contact point that both levers ask for, and how much they disagree, in body sizes.
std::pair<Vec3, double> contact_of(const Problem& problem, const State& s, const ImpactTurning& a, const ImpactTurning& b) {
  const Vec3 middle = problem.fixed ? s.p[0] : Vec3(0.5 * (s.p[0] + s.p[1])), n = s.impulse.normalized();
  const auto across = [&](const Vec3& v) { return Vec3(v - n * n.dot(v)); };
  const Vec3 from_a = across(s.p[0] + a.lever - middle), from_b = across(s.p[1] + b.lever - middle);
  if (a.has_lever && b.has_lever && !problem.fixed)
    return {middle + 0.5 * (from_a + from_b), (from_a - from_b).norm() / problem.solids[0].mass.extent};
  if (a.has_lever) return {middle + from_a, 0.0};
  if (b.has_lever && !problem.fixed) return {middle + from_b, 0.0};
  return {middle, 0.0};
}

/// Shapes unknown: where the levers say.
std::vector<Ranked> lever_starts(const Problem& problem, const State& base) {
  const std::vector<ImpactTurning> first = turnings(problem, 0, base.time, base.impulse);
  const std::vector<ImpactTurning> second = problem.fixed ? std::vector<ImpactTurning>{ImpactTurning{}} : turnings(problem, 1, base.time, Vec3(-base.impulse / base.mass_ratio));
  constexpr double kApart = 0.15;  // of the body's size: how far two levers may disagree
  std::vector<Ranked> all;
  for (const ImpactTurning& a : first)
    for (const ImpactTurning& b : second) {
      State s = base;
      s.q = {a.q, b.q};
      s.h = {a.h, b.h};
      const auto [x, apart] = contact_of(problem, s, a, b);
      s.x = x;
      s.h_after = {a.h_after, b.h_after};
      all.push_back({a.cost + b.cost + 0.5 * apart * apart / (kApart * kApart), s});
    }
  return all;
}

}  // namespace

std::vector<State> start_states(const Problem& problem, double time, int count) {
  State base;
  base.time = time;
  base.down = problem.down;
  std::array<LinearFlight, 2> flights;
  const auto fly_around = [&](const Problem& as, double t) {
    for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
      const std::optional<LinearFlight> flight = linear_flight(as, o, t);
      if (!flight) return false;
      flights[o] = *flight;
    }
    return true;
  };
  if (!fly_around(problem, time)) return {};
  for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
    base.p[o] = flights[o].p;
    base.v[o] = problem.flies(o, false) ? flights[o].v_before : Vec3(Vec3::Zero());
    base.v_after[o] = flights[o].v_after;
  }
  base.impulse = base.v_after[0] - base.v[0];
  const Vec3 other = base.v_after[1] - base.v[1];
  base.mass_ratio = problem.mass_ratio ? *problem.mass_ratio : std::clamp(base.impulse.norm() / std::max(1e-6, other.norm()), 0.05, 20.0);
  base.x = problem.fixed ? base.p[0] : Vec3(0.5 * (base.p[0] + base.p[1]));
  if (!problem.orientations.empty()) {  // impulse and time first, for what they tell of the turning
    Problem centers = problem;
    centers.orientations.clear();
    const Fit fit = approach(centers, base);
    if (fit.usable) base = fit.state;
  }
  if (!problem.touches()) return best_of(lever_starts(problem, base), count);
  Problem tilted = problem;
  tilted.down = base.down;
  if (!fly_around(tilted, base.time)) return {};
  std::vector<State> states = best_of(touching_starts(problem, base, flights), count);
  for (const State& lever : best_of(lever_starts(problem, base), std::max(1, count / 4))) {  // where the way over the shapes leads nowhere
    const Fit fit = approach(problem, lever);
    if (fit.usable) states.push_back(fit.state);
  }
  return states;
}

}  // namespace unseen::collision
