// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <optional>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kThin = 4.0;       // tolerances
constexpr double kWorth = 0.5;      // of the unrest of those that it joins: what a fixed contact must end
constexpr int kMostWork = 5000;     // fixed contacts that may be tried, times bodies, or little more

/// What stays at rest under a push from any side.
struct Rest {
  std::vector<int> group;
  std::vector<char> is_firm;   ///< a body
  std::vector<double> unrest;  ///< a body: what is out of balance, summed over loads; 0 = at rest
  double total = 0;

  bool falls(int body) const { return unrest[body] > 0.0; }
  double unrest_of_group(int body) const {
    double sum = 0;
    for (std::size_t i = 0; i < group.size(); ++i) sum += group[i] == group[body] ? unrest[i] : 0.0;
    return sum;
  }
};

Rest rest_of(const Problem& problem, const Arrangement& arrangement, const std::vector<Touch>& touches, const std::vector<char>& held) {
  const Structure s = structure_of(problem, arrangement, touches, held);
  Rest out{s.group, std::vector<char>(problem.bodies(), 0), std::vector<double>(problem.bodies(), 0.0), 0.0};
  for (int i = 0; i < problem.bodies(); ++i) out.is_firm[i] = s.bodies[s.group[i]].is_static;
  std::vector<Vec3> forces;
  for (const Vec3& load : load_cases(problem.push)) {
    const Balance b = balance(s.bodies, s.contacts, load, forces);
    forces = b.forces;
    for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
      const double unrest = b.motion[s.group[i]].norm();
      if (out.is_firm[i] || unrest < kAtRest) continue;
      out.unrest[i] += unrest;
      out.total += unrest;
    }
  }
  return out;
}

/// Whether the tolerance of its contacts is much of a box's thickness.
bool is_thin(const Problem& problem, const Arrangement& arrangement, int body) {
  const std::size_t i = body - problem.supports_count();
  return 2.0 * arrangement.boxes[i].half_size.minCoeff() < kThin * problem.tolerance[i];
}

}  // namespace

std::vector<char> hold_together(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  const Problem exact = as_written(problem);
  const std::vector<Touch> near = touching_pairs(problem, arrangement), touches = touching_pairs(exact, arrangement);
  std::vector<char> falls(problem.bodies(), 0);
  Rest now = rest_of(exact, arrangement, touches, held);
  if (now.total == 0.0) return falls;
  const Rest within_tolerance = rest_of(problem, arrangement, near, held);
  // What is thick, and would not fall if near contacts counted, moves no farther than to them.
  const auto may_fall = [&](int body) { return now.falls(body) && (within_tolerance.falls(body) || is_thin(problem, arrangement, body)); };
  for (int work = 0; now.total > 0.0 && work <= kMostWork;) {
    const auto may_help = [&](const Touch& t) {
      return !now.is_firm[t.a] && !now.is_firm[t.b] && now.group[t.a] != now.group[t.b] && !problem.are_known_objects(t.a, t.b) &&
             (may_fall(t.a) || may_fall(t.b));
    };
    std::optional<Rest> best;
    std::array<int, 2> link;
    for (const Touch& touch : near) {
      if (!may_help(touch)) continue;
      work += problem.bodies();
      context.check();
      Arrangement joined = arrangement;
      joined.fix({touch.a, touch.b});
      Rest then = rest_of(exact, joined, touches, held);
      const double before = now.unrest_of_group(touch.a) + now.unrest_of_group(touch.b);
      if (now.total - then.total < kWorth * before || (best && then.total >= best->total)) continue;
      best = std::move(then);
      link = {touch.a, touch.b};
    }
    if (!best) break;
    now = std::move(*best);
    arrangement.fix(link);
  }
  for (int i = 0; i < problem.bodies(); ++i) falls[i] = now.falls(i);
  return falls;
}

}  // namespace unseen::cuboids
