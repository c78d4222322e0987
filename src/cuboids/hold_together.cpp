// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <optional>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kExactly = 0.03;   // tolerances: contacts of the boxes as they will be written
constexpr double kAtRest = 1e-3;    // residual: what is not balanced falls in the end, if slowly
constexpr double kThin = 4.0;       // tolerances
constexpr double kNudge = 0.03;     // g: sticks on end bear less, and do not stay for long
constexpr int kMostWork = 5000;     // fixed contacts that may be tried, times bodies

/// Statics of boxes that only touch where they do.
struct Exact {
  std::vector<int> group;
  std::vector<char> is_firm, falls;  ///< a body
  double unrest = 0;                 ///< what is out of balance, summed over what falls
};

Exact exactly(const Problem& exact, const Arrangement& arrangement, const std::vector<Touch>& touches, const std::vector<char>& held) {
  const Structure s = structure_of(exact, arrangement, touches, held);
  Exact out{s.group, std::vector<char>(exact.bodies(), 0), std::vector<char>(exact.bodies(), 0), 0.0};
  for (int i = 0; i < exact.bodies(); ++i) out.is_firm[i] = s.bodies[s.group[i]].is_static;
  std::vector<Vec3> forces;
  for (const Vec3& load : load_cases(kNudge)) {
    const Balance b = balance(s.bodies, s.contacts, load, forces);
    forces = b.forces;
    for (int i = exact.supports_count(); i < exact.bodies(); ++i) {
      const double unrest = b.motion[s.group[i]].norm();
      if (out.is_firm[i] || unrest < kAtRest) continue;
      out.falls[i] = 1;
      out.unrest += unrest;
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

void hold_together(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  Problem exact = problem;
  for (double& tolerance : exact.tolerance) tolerance *= kExactly;
  const std::vector<Touch> near = touching_pairs(problem, arrangement), touches = touching_pairs(exact, arrangement);
  Exact now = exactly(exact, arrangement, touches, held);
  int work = 0;
  while (now.unrest > 0.0) {
    const auto needs_help = [&](int body) { return now.falls[body] && is_thin(problem, arrangement, body); };
    const auto may_help = [&](const Touch& t) {
      return !now.is_firm[t.a] && !now.is_firm[t.b] && now.group[t.a] != now.group[t.b] && !problem.are_known_objects(t.a, t.b) &&
             (needs_help(t.a) || needs_help(t.b));
    };
    std::optional<Exact> best;
    std::array<int, 2> pair;
    for (const Touch& touch : near) {
      if (!may_help(touch)) continue;
      if ((work += problem.bodies()) > kMostWork) return;
      context.check();
      Arrangement joined = arrangement;
      joined.fixed.push_back({touch.a, touch.b});
      Exact then = exactly(exact, joined, touches, held);
      if (then.unrest >= (best ? *best : now).unrest) continue;
      best = std::move(then);
      pair = {touch.a, touch.b};
    }
    if (!best) return;
    now = std::move(*best);
    arrangement.fixed.push_back(pair);
    std::sort(arrangement.fixed.begin(), arrangement.fixed.end());
  }
}

}  // namespace unseen::cuboids
