// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/turnings.h"

#include <algorithm>

#include "collision/rotation.h"
#include "collision/spin_starts.h"
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

}  // namespace

std::vector<ImpactTurning> turnings(const Problem& problem, int body, double time, const Vec3& impulse) {
  const std::vector<SpinGuess> before = spin_guesses(problem, body, false, time), after = spin_guesses(problem, body, true, time);
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
  const double reach = problem.solids[body].mass.reach, square = std::max(1e-9, impulse.squaredNorm());
  for (const SpinGuess& a : before)
    for (const SpinGuess& b : after) {
      const Vec3 change = b.h - a.h;
      const double meet = rotation_vector<double>(b.q * a.q.conjugate()).norm() / kMeet;
      ImpactTurning t{between(a.q, b.q), a.h, b.h, impulse.cross(change) / square, true, a.cost + b.cost + 0.5 * meet * meet, a.spread, b.spread};
      const double along = change.dot(impulse) / std::sqrt(square) / (reach * std::sqrt(square)), beyond = std::max(0.0, t.lever.norm() / reach - 1.0);
      t.cost += 0.5 * (along * along + beyond * beyond) * 100.0;
      all.push_back(t);
    }
  std::stable_sort(all.begin(), all.end(), [](const ImpactTurning& a, const ImpactTurning& b) { return a.cost < b.cost; });
  return all;
}

std::vector<TurningPair> turning_pairs(const Problem& problem, const State& base, int shakes) {
  constexpr std::size_t kTurnings = 6, kPairs = 16, kShakenTurnings = 2;
  constexpr double kHopeless = 60.0;      // ½ χ²
  constexpr double kWorthShaking = 0.03;  // rad
  std::vector<TurningPair> pairs;
  const auto add = [&](const Problem& seen, std::size_t most_each, std::size_t most) {
    const std::vector<ImpactTurning> first = turnings(seen, 0, base.time, base.impulse), second = turnings(seen, 1, base.time, Vec3(-base.impulse / base.mass_ratio));
    std::vector<TurningPair> some;
    for (std::size_t i = 0; i < std::min(first.size(), most_each); ++i)
      for (std::size_t j = 0; j < std::min(second.size(), most_each); ++j) some.push_back({first[i], second[j]});
    std::stable_sort(some.begin(), some.end(), [](const TurningPair& a, const TurningPair& b) { return a.cost() < b.cost(); });
    if (some.size() > most) some.resize(most);
    std::erase_if(some, [limit = some.front().cost() + kHopeless](const TurningPair& p) { return p.cost() > limit; });
    pairs.insert(pairs.end(), some.begin(), some.end());
  };
  add(problem, kTurnings, kPairs);
  if (problem.orientations.empty() || !problem.scattered || problem.orientation_sigma < kWorthShaking) return pairs;
  Random random(1);
  for (int i = 0; i < shakes; ++i) add(shaken(problem, random), kShakenTurnings, kShakenTurnings);
  return pairs;
}

}  // namespace unseen::collision
