// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/turnings.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/solve/rotation.h"
#include "collision/solve/spin_starts.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

Quat between(const Quat& a, const Quat& b) { return a.slerp(0.5, b).normalized(); }

/// The orientations as they might have been seen.
Problem shaken(Problem problem, Random& random) {
  for (OrientationObservation& o : problem.orientations)
    o.q = (rotation_by<double>(Vec3(problem.orientation_sigma * Vec3(random.normal(), random.normal(), random.normal()))) * o.q).normalized();
  return problem;
}

/// How a body may have turned before and after.
struct Sides {
  std::vector<SpinGuess> before, after;
};

Sides sides_of(const Problem& problem, int body, double time) { return {spin_guesses(problem, body, false, time), spin_guesses(problem, body, true, time)}; }

/// Guesses as orientations that are off by their noise would have them.
void shake(std::vector<SpinGuess>& guesses, Random& random) {
  for (SpinGuess& guess : guesses) {
    Eigen::Matrix<double, 6, 1> off;
    for (double& x : off) x = random.normal();
    off = guess.covariance.llt().matrixL() * off;
    guess.q = (rotation_by<double>(Vec3(off.head<3>())) * guess.q).normalized();
    guess.h += off.tail<3>();
  }
}

/// ½ χ² of the two sides: where whole turns are open there are many, of which this has to find the right ones.
double joined_cost(const SpinGuess& a, const SpinGuess& b, const Vec3& inertia, const Vec3& direction) {
  constexpr double kTime = 0.002, kDirection = 0.05;  // s, rad: of the impact and its impulse, as centres tell them
  const Vec3 off = rotation_vector<double>(b.q * a.q.conjugate()), change = b.h - a.h;
  const Vec3 late = kTime * (angular_velocity<double>(b.q, b.h, inertia) - angular_velocity<double>(a.q, a.h, inertia));
  const Mat3 spread = a.covariance.topLeftCorner<3, 3>() + b.covariance.topLeftCorner<3, 3>() + late * late.transpose();
  const double along = change.dot(direction), across = (change - along * direction).norm();
  const double variance = direction.dot((a.spread + b.spread) * direction) + std::pow(kDirection * across, 2);
  return 0.5 * (off.dot(spread.inverse() * off) + along * along / variance);
}

std::vector<ImpactTurning> joined(const Sides& sides, const MassProperties& mass, const Vec3& impulse) {
  const auto& [before, after] = sides;
  std::vector<ImpactTurning> all;
  if (before.empty() && after.empty()) return {ImpactTurning{}};
  if (before.empty() || after.empty()) {
    for (const SpinGuess& guess : before.empty() ? after : before) {
      ImpactTurning t;
      t.q = guess.q, t.h = t.h_after = guess.h, t.cost = guess.cost;
      all.push_back(t);
    }
    return all;
  }
  constexpr double kMeet = 0.35;  // rad: how far extrapolated orientations may be off at the impact
  const double reach = mass.reach, square = std::max(1e-9, impulse.squaredNorm());
  for (const SpinGuess& a : before)
    for (const SpinGuess& b : after) {
      const Vec3 change = b.h - a.h;
      ImpactTurning t{between(a.q, b.q), a.h, b.h, impulse.cross(change) / square, true, a.cost + b.cost, a.spread, b.spread};
      const double beyond = std::max(0.0, t.lever.norm() / reach - 1.0);
      t.cost += 0.5 * beyond * beyond * 100.0;
      if (a.open && b.open) {
        t.cost += joined_cost(a, b, mass.inertia, impulse / std::sqrt(square));
      } else {
        const double meet = rotation_vector<double>(b.q * a.q.conjugate()).norm() / kMeet, along = change.dot(impulse) / std::sqrt(square) / (reach * std::sqrt(square));
        t.cost += 0.5 * (meet * meet + along * along * 100.0);
      }
      all.push_back(t);
    }
  std::stable_sort(all.begin(), all.end(), [](const ImpactTurning& a, const ImpactTurning& b) { return a.cost < b.cost; });
  return all;
}

}  // namespace

std::vector<ImpactTurning> turnings(const Problem& problem, int body, double time, const Vec3& impulse) {
  return joined(sides_of(problem, body, time), problem.solids[body].mass, impulse);
}

std::vector<TurningPair> turning_pairs(const Problem& problem, const State& base, int shakes) {
  constexpr std::size_t kTurnings = 6, kPairs = 16, kShakenTurnings = 2;
  constexpr std::size_t kOpenTurnings = 24, kOpenPairs = 96, kShakenOpenTurnings = 3;
  constexpr double kHopeless = 60.0;      // ½ χ²
  constexpr double kWorthShaking = 0.03;  // rad
  std::vector<TurningPair> pairs;
  const std::array<Vec3, 2> impulses = {base.impulse, Vec3(-base.impulse / base.mass_ratio)};
  const std::array<Sides, 2> sides = {sides_of(problem, 0, base.time), sides_of(problem, 1, base.time)};
  const auto is_open = [](const std::vector<SpinGuess>& guesses) { return !guesses.empty() && guesses.front().open; };
  const bool open = std::any_of(sides.begin(), sides.end(), [&](const Sides& s) { return is_open(s.before) || is_open(s.after); });
  const auto add = [&](const std::array<Sides, 2>& seen, std::size_t most_each, std::size_t most) {
    const std::vector<ImpactTurning> first = joined(seen[0], problem.solids[0].mass, impulses[0]), second = joined(seen[1], problem.solids[1].mass, impulses[1]);
    std::vector<TurningPair> some;
    for (std::size_t i = 0; i < std::min(first.size(), most_each); ++i)
      for (std::size_t j = 0; j < std::min(second.size(), most_each); ++j) some.push_back({first[i], second[j]});
    std::stable_sort(some.begin(), some.end(), [](const TurningPair& a, const TurningPair& b) { return a.cost() < b.cost(); });
    if (some.size() > most) some.resize(most);
    std::erase_if(some, [limit = some.front().cost() + kHopeless](const TurningPair& p) { return p.cost() > limit; });
    pairs.insert(pairs.end(), some.begin(), some.end());
  };
  add(sides, open ? kOpenTurnings : kTurnings, open ? kOpenPairs : kPairs);
  if (problem.orientations.empty() || !problem.scattered || problem.orientation_sigma < kWorthShaking) return pairs;
  Random random(1);
  for (int i = 0; i < shakes; ++i) {
    const Problem other = shaken(problem, random);
    std::array<Sides, 2> off = sides;
    for (int body = 0; body < 2; ++body)
      for (const bool after : {false, true}) {
        std::vector<SpinGuess>& guesses = after ? off[body].after : off[body].before;
        if (is_open(guesses)) {
          shake(guesses, random);
        } else {
          guesses = spin_guesses(other, body, after, base.time);
        }
      }
    add(off, open ? kShakenOpenTurnings : kShakenTurnings, open ? kShakenOpenTurnings : kShakenTurnings);
  }
  return pairs;
}

}  // namespace unseen::collision
