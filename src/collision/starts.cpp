// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/starts.h"

#include <algorithm>
#include <numeric>

#include "collision/linear_flights.h"
#include "collision/rotation.h"
#include "collision/solve.h"
#include "collision/spin_starts.h"

namespace unseen::collision {
namespace {

/// A body's turning through the impact: at it, and the lever (across the impulse) that the change of momentum asks for.
struct Turning {
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero(), h_after = Vec3::Zero(), lever = Vec3::Zero();
  bool has_lever = false;
  double cost = 0;
};

Quat between(const Quat& a, const Quat& b) { return a.slerp(0.5, b).normalized(); }

/// Pairs of guesses before and after, ranked by how well they meet at the impact. `impulse` is the body's own, per its mass.
std::vector<Turning> turnings(const Problem& problem, int body, double time, const Vec3& impulse) {
  const std::vector<SpinGuess> before = spin_guesses(problem, body, false, time), after = spin_guesses(problem, body, true, time);
  std::vector<Turning> all;
  if (before.empty() && after.empty()) return {Turning{}};
  if (before.empty() || after.empty()) {
    for (const SpinGuess& guess : before.empty() ? after : before) all.push_back({guess.q, guess.h, guess.h, Vec3::Zero(), false, guess.cost});
    return all;
  }
  constexpr double kMeet = 0.35;  // rad: how far extrapolated orientations may be off at the impact
  const double reach = problem.solids[body].mass.reach, square = std::max(1e-9, impulse.squaredNorm());
  for (const SpinGuess& a : before)
    for (const SpinGuess& b : after) {
      const Vec3 change = b.h - a.h;
      const double meet = rotation_vector<double>(b.q * a.q.conjugate()).norm() / kMeet;
      Turning t{between(a.q, b.q), a.h, b.h, impulse.cross(change) / square, true, a.cost + b.cost + 0.5 * meet * meet};
      const double along = change.dot(impulse) / std::sqrt(square) / (reach * std::sqrt(square)), beyond = std::max(0.0, t.lever.norm() / reach - 1.0);
      t.cost += 0.5 * (along * along + beyond * beyond) * 100.0;
      all.push_back(t);
    }
  std::stable_sort(all.begin(), all.end(), [](const Turning& a, const Turning& b) { return a.cost < b.cost; });
  return all;
}

/// The contact point that both levers ask for, and how much they disagree, in body sizes.
std::pair<Vec3, double> contact_of(const Problem& problem, const State& s, const Turning& a, const Turning& b) {
  const Vec3 middle = problem.fixed ? s.p[0] : Vec3(0.5 * (s.p[0] + s.p[1])), n = s.impulse.normalized();
  const auto across = [&](const Vec3& v) { return Vec3(v - n * n.dot(v)); };
  const Vec3 from_a = across(s.p[0] + a.lever - middle), from_b = across(s.p[1] + b.lever - middle);
  if (a.has_lever && b.has_lever && !problem.fixed)
    return {middle + 0.5 * (from_a + from_b), (from_a - from_b).norm() / problem.solids[0].mass.extent};
  if (a.has_lever) return {middle + from_a, 0.0};
  if (b.has_lever && !problem.fixed) return {middle + from_b, 0.0};
  return {middle, 0.0};
}

}  // namespace

std::vector<State> start_states(const Problem& problem, double time, int count) {
  State base;
  base.time = time;
  base.down = problem.down;
  for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
    const std::optional<LinearFlight> flight = linear_flight(problem, o, time);
    if (!flight) return {};
    base.p[o] = flight->p;
    base.v[o] = flight->v_before;
    base.v_after[o] = flight->v_after;
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
    time = base.time;
  }
  const std::vector<Turning> first = turnings(problem, 0, time, base.impulse);
  const std::vector<Turning> second = problem.fixed ? std::vector<Turning>{Turning{}} : turnings(problem, 1, time, Vec3(-base.impulse / base.mass_ratio));
  struct Ranked {
    double cost;
    State state;
  };
  std::vector<Ranked> all;
  constexpr double kApart = 0.15;  // of the body's size: how far two levers may disagree
  for (const Turning& a : first)
    for (const Turning& b : second) {
      State s = base;
      s.q = {a.q, b.q};
      s.h = {a.h, b.h};
      const auto [x, apart] = contact_of(problem, s, a, b);
      s.x = x;
      s.h_after = {a.h_after, b.h_after};
      all.push_back({a.cost + b.cost + 0.5 * apart * apart / (kApart * kApart), s});
    }
  std::stable_sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  std::vector<State> states;
  for (const Ranked& r : all)
    if (static_cast<int>(states.size()) < count) states.push_back(r.state);
  return states;
}

}  // namespace unseen::collision
