// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/starts.h"

#include <algorithm>
#include <numeric>

#include "collision/linear_flights.h"
#include "collision/rotation.h"
#include "collision/solve.h"
#include "collision/spin_starts.h"
#include "collision/touching_fit.h"
#include "collision/unknowns.h"
#include "collision/views.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// A body's turning through the impact: at it, and the lever (across the impulse) that the change of momentum asks for.
struct Turning {
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero(), h_after = Vec3::Zero(), lever = Vec3::Zero();
  bool has_lever = false;
  double cost = 0;
  Mat3 spread = Mat3::Zero(), spread_after = Mat3::Zero();  // covariances of h and h_after

  TouchingFit::Turn turn() const {
    if (!has_lever) return {};
    return {h_after - h, Mat3((spread + spread_after).inverse())};
  }
};

Quat between(const Quat& a, const Quat& b) { return a.slerp(0.5, b).normalized(); }

/// Pairs of guesses before and after, ranked by how well they meet at the impact. `impulse` is the body's own, per its mass.
std::vector<Turning> turnings(const Problem& problem, int body, double time, const Vec3& impulse) {
  const std::vector<SpinGuess> before = spin_guesses(problem, body, false, time), after = spin_guesses(problem, body, true, time);
  std::vector<Turning> all;
  if (before.empty() && after.empty()) return {Turning{}};
  if (before.empty() || after.empty()) {
    for (const SpinGuess& guess : before.empty() ? after : before) {
      Turning t;
      t.q = guess.q, t.h = t.h_after = guess.h, t.cost = guess.cost;
      all.push_back(t);
    }
    return all;
  }
  constexpr double kMeet = 0.35;  // rad: how far extrapolated orientations may be off at the impact
  const double reach = problem.solids[body].mass.reach, square = std::max(1e-9, impulse.squaredNorm());
  for (const SpinGuess& a : before)
    for (const SpinGuess& b : after) {
      const Vec3 change = b.h - a.h;
      const double meet = rotation_vector<double>(b.q * a.q.conjugate()).norm() / kMeet;
      Turning t{between(a.q, b.q), a.h, b.h, impulse.cross(change) / square, true, a.cost + b.cost + 0.5 * meet * meet, a.spread, b.spread};
      const double along = change.dot(impulse) / std::sqrt(square) / (reach * std::sqrt(square)), beyond = std::max(0.0, t.lever.norm() / reach - 1.0);
      t.cost += 0.5 * (along * along + beyond * beyond) * 100.0;
      all.push_back(t);
    }
  std::stable_sort(all.begin(), all.end(), [](const Turning& a, const Turning& b) { return a.cost < b.cost; });
  return all;
}

struct Ranked {
  double cost;
  State state;
};

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

/// Shapes unknown: where the levers say.
std::vector<Ranked> lever_starts(const Problem& problem, const State& base) {
  const std::vector<Turning> first = turnings(problem, 0, base.time, base.impulse);
  const std::vector<Turning> second = problem.fixed ? std::vector<Turning>{Turning{}} : turnings(problem, 1, base.time, Vec3(-base.impulse / base.mass_ratio));
  constexpr double kApart = 0.15;  // of the body's size: how far two levers may disagree
  std::vector<Ranked> all;
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
  return all;
}

/// Momenta on both sides that agree with the impulse's lever.
void share_change(const Turning& turning, const Vec3& change, Vec3& h, Vec3& h_after) {
  h = turning.h, h_after = turning.h + change;
  if (!turning.has_lever) return;
  h -= turning.spread * (turning.spread + turning.spread_after).inverse() * (change - (turning.h_after - turning.h));
  h_after = h + change;
}

/// The orientations as they might have been seen.
Problem shaken(Problem problem, Random& random) {
  for (OrientationObservation& o : problem.orientations)
    o.q = (rotation_by<double>(Vec3(problem.orientation_sigma * Vec3(random.normal(), random.normal(), random.normal()))) * o.q).normalized();
  return problem;
}

struct Pair {
  Turning a, b;
  double cost() const { return a.cost + b.cost; }
};

/// How both bodies may have turned, the best first; noisy orientations are tried shaken as well, since a small turn may decide where the shapes touch.
std::vector<Pair> turning_pairs(const Problem& problem, const State& base, int shakes) {
  constexpr std::size_t kTurnings = 6, kPairs = 16, kShakenTurnings = 2;
  constexpr double kHopeless = 60.0;      // ½ χ²
  constexpr double kWorthShaking = 0.03;  // rad
  std::vector<Pair> pairs;
  const auto add = [&](const Problem& seen, std::size_t most_each, std::size_t most) {
    const std::vector<Turning> first = turnings(seen, 0, base.time, base.impulse), second = turnings(seen, 1, base.time, Vec3(-base.impulse / base.mass_ratio));
    std::vector<Pair> some;
    for (std::size_t i = 0; i < std::min(first.size(), most_each); ++i)
      for (std::size_t j = 0; j < std::min(second.size(), most_each); ++j) some.push_back({first[i], second[j]});
    std::stable_sort(some.begin(), some.end(), [](const Pair& a, const Pair& b) { return a.cost() < b.cost(); });
    if (some.size() > most) some.resize(most);
    std::erase_if(some, [limit = some.front().cost() + kHopeless](const Pair& p) { return p.cost() > limit; });
    pairs.insert(pairs.end(), some.begin(), some.end());
  };
  add(problem, kTurnings, kPairs);
  if (problem.orientations.empty() || !problem.scattered || problem.orientation_sigma < kWorthShaking) return pairs;
  Random random(1);
  for (int i = 0; i < shakes; ++i) add(shaken(problem, random), kShakenTurnings, kShakenTurnings);
  return pairs;
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

  std::optional<Ranked> at(const Pair& pair, const Vec3& direction) const {
    constexpr double kBeyond = 0.1;  // restitution outside [0,1]
    const std::optional<Touching> touching = touch_along(problem_.solids[0], pair.a.q, problem_.solids[1], pair.b.q, direction);
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
  Ranked refined(const Pair& pair, Ranked best) const {
    constexpr int kRounds = 16;
    double step = 0.08;  // rad
    for (int round = 0; round < kRounds; ++round) {
      const Vec3 direction = (best.state.p[0] - best.state.p[1]).normalized(), e1 = any_orthogonal(direction), e2 = direction.cross(e1);
      bool better = false;
      for (const Vec3& side : {e1, e2, Vec3(-e1), Vec3(-e2)}) {
        const std::optional<Ranked> next = at(pair, (direction + step * side).normalized());
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

/// All ways in which the two can touch, each with the impulse that explains the flights best.
std::vector<Ranked> touching_starts(const Problem& problem, const State& base, const std::array<LinearFlight, 2>& flights) {
  constexpr int kTouchings = 4000;   // for all shakes together
  constexpr std::size_t kRefined = 4;  // of each pair of turnings
  const TouchingStarts starts(problem, base, flights);
  const std::vector<Vec3> directions = possible_offsets(problem, flights);
  const int shakes = kTouchings / (2 * static_cast<int>(directions.size()));
  std::vector<Ranked> all;
  for (const Pair& pair : turning_pairs(problem, base, shakes)) {
    std::vector<Ranked> some;
    for (const Vec3& direction : directions)
      if (std::optional<Ranked> start = starts.at(pair, direction)) some.push_back(std::move(*start));
    std::stable_sort(some.begin(), some.end(), [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
    for (std::size_t i = 0; i < std::min(some.size(), kRefined); ++i) all.push_back(starts.refined(pair, some[i]));
    all.insert(all.end(), some.begin(), some.end());
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
    base.v[o] = flights[o].v_before;
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
