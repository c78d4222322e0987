// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <optional>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kNudge = 0.03;     // g: sticks on end bear less, and do not stay for long
constexpr double kWorth = 0.5;      // of the unrest of those that it joins: what a fixed contact must end
constexpr int kMostWork = 5000;     // fixed contacts that may be tried, times bodies, or little more

/// Statics of boxes that only touch where they do.
struct Exact {
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

Exact exactly(const Problem& exact, const Arrangement& arrangement, const std::vector<Touch>& touches, const std::vector<char>& held) {
  const Structure s = structure_of(exact, arrangement, touches, held);
  Exact out{s.group, std::vector<char>(exact.bodies(), 0), std::vector<double>(exact.bodies(), 0.0), 0.0};
  for (int i = 0; i < exact.bodies(); ++i) out.is_firm[i] = s.bodies[s.group[i]].is_static;
  std::vector<Vec3> forces;
  for (const Vec3& load : load_cases(kNudge)) {
    const Balance b = balance(s.bodies, s.contacts, load, forces);
    forces = b.forces;
    for (int i = exact.supports_count(); i < exact.bodies(); ++i) {
      const double unrest = b.motion[s.group[i]].norm();
      if (out.is_firm[i] || unrest < kAtRest) continue;
      out.unrest[i] += unrest;
      out.total += unrest;
    }
  }
  return out;
}

}  // namespace

void hold_together(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  const Problem exact = as_written(problem);
  const std::vector<Touch> near = touching_pairs(problem, arrangement), touches = touching_pairs(exact, arrangement);
  Exact now = exactly(exact, arrangement, touches, held);
  for (int work = 0; now.total > 0.0 && work <= kMostWork;) {
    const auto may_help = [&](const Touch& t) {
      return !now.is_firm[t.a] && !now.is_firm[t.b] && now.group[t.a] != now.group[t.b] && !problem.are_known_objects(t.a, t.b) &&
             (now.falls(t.a) || now.falls(t.b));
    };
    std::optional<Exact> best;
    std::array<int, 2> link;
    for (const Touch& touch : near) {
      if (!may_help(touch)) continue;
      work += problem.bodies();
      context.check();
      Arrangement joined = arrangement;
      joined.fix({touch.a, touch.b});
      Exact then = exactly(exact, joined, touches, held);
      const double before = now.unrest_of_group(touch.a) + now.unrest_of_group(touch.b);
      if (now.total - then.total < kWorth * before || (best && then.total >= best->total)) continue;
      best = std::move(then);
      link = {touch.a, touch.b};
    }
    if (!best) break;
    now = std::move(*best);
    arrangement.fix(link);
  }
}

}  // namespace unseen::cuboids
