// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/unknowns.h"

#include <algorithm>

#include "unseen/core/error.h"

namespace unseen::collision {

bool Problem::turns(int body) const {
  return terms.orientation && std::any_of(orientations.begin(), orientations.end(), [body](const auto& o) { return o.body == body; });
}

Terms terms_of(const std::string& physics, const std::string& without) {
  Terms terms;
  terms.soft = physics == "soft";
  const std::pair<const char*, bool*> known[] = {{"momentum", &terms.momentum},       {"impulse", &terms.impulse}, {"energy", &terms.energy},
                                                 {"restitution", &terms.restitution}, {"gravity", &terms.gravity}, {"size", &terms.size},
                                                 {"orientation", &terms.orientation}};
  for (std::size_t at = 0; at < without.size();) {
    const std::size_t end = std::min(without.find(',', at), without.size());
    const std::string name = without.substr(at, end - at);
    const auto term = std::find_if(std::begin(known), std::end(known), [&](const auto& k) { return name == k.first; });
    if (term == std::end(known))
      throw InputError("option", "without", name, "momentum, impulse, energy, restitution, gravity, size or orientation, separated by commas");
    *term->second = false;
    at = end + 1;
  }
  return terms;
}

State state_at(const Problem& problem, const State& reference, const double* u) {
  const StateT<double> s = unpack<double>(problem, reference, u);
  State state = reference;
  state.time = s.time;
  state.down = s.down;
  state.p = s.p;
  state.v = s.v;
  state.h = s.h;
  state.q = s.q;
  for (Quat& q : state.q) q.normalize();
  state.x = s.x;
  state.impulse = s.impulse;
  state.mass_ratio = s.mass_ratio;
  state.v_after = s.v_after;
  state.h_after = s.h_after;
  return state;
}

StateT<double> values_of(const Problem& problem, const State& state) {
  const std::array<double, kUnknowns> zero = {};
  return unpack<double>(problem, state, zero.data());
}

StateT<Wide> wide_values_of(const Problem& problem, const State& state) {
  std::array<Wide, kUnknowns> u;
  for (int i = 0; i < kUnknowns; ++i) u[i] = Wide(0.0, i);
  return unpack<Wide>(problem, state, u.data());
}

Quat orientation_at(const Problem& problem, const State& state, int o, bool after, double time) {
  if (o == 1 && problem.fixed) return state.q[1];
  const StateT<double> s = values_of(problem, state);
  return turned(s.q[o], after ? s.h_after[o] : s.h[o], problem.solids[o].mass.inertia, time - state.time);
}

}  // namespace unseen::collision
