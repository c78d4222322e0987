// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kGoodResidual = 1e-6;
constexpr int kDescents = 12, kRounds = 8;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr int kMostGrowth = 1200;  // arrangements that growing faces may be tried with, times bodies
constexpr double kBetter = 0.9;  // of the energy: a step that leaves more is not worth its volume
constexpr double kProbe = 1e-4;  // m, of the derivative

/// An arrangement with its balance at rest and under pushes.
struct State {
  Arrangement arrangement;
  std::vector<Touch> touches;
  Structure structure;
  std::vector<Balance> balances;  ///< one a load
  std::vector<double> energies;   ///< a load: what is out of balance, squared and summed over bodies
  double residual = 0;            ///< the largest of the balances
  double energy = 0;              ///< summed over loads

  double motion(int body) const {
    double largest = 0;
    for (const Balance& b : balances) largest = std::max(largest, b.motion[body].norm());
    return largest;
  }
};

/// Sum over bodies of the squared unbalanced force and torque, scaled, if given forces act on a structure under a load.
double energy(const Structure& structure, const Vec3& load, const std::vector<Vec3>& forces) {
  std::vector<Vec3> force(structure.bodies.size()), torque(structure.bodies.size(), Vec3::Zero());
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = structure.bodies[i].weight * load;
  for (std::size_t c = 0; c < structure.contacts.size(); ++c) {
    const ContactPoint& contact = structure.contacts[c];
    force[contact.a] -= forces[c];
    force[contact.b] += forces[c];
    torque[contact.a] -= (contact.position - structure.bodies[contact.a].center).cross(forces[c]);
    torque[contact.b] += (contact.position - structure.bodies[contact.b].center).cross(forces[c]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const Body& body = structure.bodies[i];
    if (body.is_static) continue;
    sum += (force[i] / body.weight).squaredNorm() + (torque[i] / (body.weight * body.half_size)).squaredNorm();
  }
  return sum;
}

/// The same summed over all loads, with the forces of a state.
double energy(const Problem& problem, const Structure& structure, const State& state) {
  const std::vector<Vec3> loads = load_cases(problem.push);
  double sum = 0.0;
  for (std::size_t k = 0; k < loads.size(); ++k) sum += energy(structure, loads[k], state.balances[k].forces);
  return sum;
}

/// None if its energy is above the limit, which shows soonest by the loads under which a state that is nearly the same was least at rest.
std::optional<State> state_of(const Problem& problem, const std::vector<char>& held, Arrangement arrangement, double limit, const State* nearly = nullptr) {
  const std::vector<Vec3> loads = load_cases(problem.push);
  State s{std::move(arrangement), {}, {}, std::vector<Balance>(loads.size()), std::vector<double>(loads.size()), 0.0, 0.0};
  s.touches = touching_pairs(problem, s.arrangement);
  s.structure = structure_of(problem, s.arrangement, s.touches, held);
  std::vector<std::size_t> order(loads.size());
  std::iota(order.begin(), order.end(), 0);
  if (nearly) std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return nearly->energies[a] > nearly->energies[b]; });
  std::vector<Vec3> start;
  if (nearly && nearly->structure.contacts.size() == s.structure.contacts.size()) start = nearly->balances[order.front()].forces;
  for (const std::size_t k : order) {
    s.balances[k] = balance(s.structure.bodies, s.structure.contacts, loads[k], start);
    if (k == order.front()) start = s.balances[k].forces;
    s.residual = std::max(s.residual, s.balances[k].residual);
    s.energy += s.energies[k] = energy(s.structure, loads[k], s.balances[k].forces);
    if (s.energy >= limit) return std::nullopt;
  }
  return s;
}

/// Derivative of the energy by each face, the forces kept (they are at their best, so theirs does not count).
std::vector<Extension> gradient(const Problem& problem, const std::vector<char>& held, const State& s) {
  std::vector<Extension> out(problem.cuboids.size(), Extension{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int body = problem.supports_count() + static_cast<int>(i);
    const int group = s.structure.group[body];
    if (s.structure.bodies[group].is_static || s.motion(group) < kGoodResidual) continue;
    for (int face = 0; face < 6; ++face) {
      const Arrangement probe = with_face(problem, s.arrangement, static_cast<int>(i), face, kProbe);
      const Structure there = structure_of(problem, probe, with_moved(problem, probe, s.touches, body), held);
      if (there.contacts.size() != s.structure.contacts.size()) continue;
      out[i][face] = (energy(problem, there, s) - s.energy) / kProbe;
    }
  }
  return out;
}

/// Where no small step helps any more: one hidden face after the other grows, the one that helps most, by the least
/// that does.
State grow_hidden_faces(const Problem& problem, const Rooms& rooms, const Admissible& admissible, const std::vector<char>& held, State now,
                        Context& context) {
  int work = 0;
  for (int round = 0; round < kRounds && now.residual > kGoodResidual; ++round) {
    std::vector<char> is_near(now.structure.bodies.size(), 0);
    const auto moves = [&](int group) { return !now.structure.bodies[group].is_static && now.motion(group) > kGoodResidual; };
    for (const ContactPoint& c : now.structure.contacts)
      if (moves(c.a) || moves(c.b)) is_near[c.a] = is_near[c.b] = 1;
    double least = kBetter * now.energy;
    std::optional<State> best;
    for (std::size_t i = 0; i < problem.cuboids.size(); ++i) {
      context.check();
      const double tolerance = problem.tolerance[i];
      if (!is_near[now.structure.group[problem.supports_count() + i]]) continue;
      for (int face = 0; face < 6; ++face) {
        if (rooms[i][face] <= kHiddenRoom * tolerance) continue;
        for (double step = tolerance; step <= rooms[i][face] - now.arrangement.extension[i][face]; step *= 2.0) {
          Arrangement next = with_face(problem, now.arrangement, static_cast<int>(i), face, step);
          close_contacts(problem, touching_pairs(problem, next), next);
          if (penetrates(problem, next) || !admissible(next)) break;
          if ((work += problem.bodies()) > kMostGrowth) return best ? *best : now;
          auto there = state_of(problem, held, std::move(next), least, &now);
          if (!there) continue;
          least = there->energy < kGoodResidual * kGoodResidual ? 0.0 : kBetter * there->energy;
          best = std::move(there);
        }
      }
    }
    if (!best) break;
    now = std::move(*best);
  }
  return now;
}

}  // namespace

void lower_residual(const Problem& problem, const Rooms& rooms, const Admissible& admissible, const std::vector<char>& held,
                    Arrangement& arrangement, Context& context) {
  State now = *state_of(problem, held, arrangement, kNoLimit);
  const std::vector<Extension> start = arrangement.extension;
  for (int step = 0; step < kDescents && now.residual > kGoodResidual; ++step) {
    context.check();
    const std::vector<Extension> slope = gradient(problem, held, now);
    double squared = 0.0;
    for (const Extension& e : slope)
      for (const double g : e) squared += g * g;
    if (squared <= 0.0) break;
    bool better = false;
    for (double share = 1.0; share > 0.05 && !better; share *= 0.5) {
      Arrangement next = now.arrangement;
      for (std::size_t i = 0; i < slope.size(); ++i)
        for (int face = 0; face < 6; ++face) {
          if (slope[i][face] == 0.0) continue;
          // Newton's step along the gradient for an energy whose least is 0; faces that were seen stay within noise.
          const double tolerance = problem.tolerance[i], hidden = rooms[i][face] - start[i][face];
          const double inward = start[i][face] > tolerance ? 4.0 * tolerance : 0.5 * tolerance;
          const double outward = hidden > kHiddenRoom * tolerance ? hidden : 0.5 * tolerance;
          const double wanted = now.arrangement.extension[i][face] - share * 2.0 * now.energy / squared * slope[i][face];
          const double allowed = std::clamp(wanted, start[i][face] - inward, start[i][face] + outward);
          next = with_face(problem, std::move(next), static_cast<int>(i), face, allowed - next.extension[i][face]);
        }
      close_contacts(problem, touching_pairs(problem, next), next);
      if (penetrates(problem, next) || !admissible(next)) continue;
      if (auto there = state_of(problem, held, std::move(next), 0.98 * now.energy, &now)) {
        now = std::move(*there);
        better = true;
      }
    }
    if (!better) break;
  }
  arrangement = grow_hidden_faces(problem, rooms, admissible, held, std::move(now), context).arrangement;
}

}  // namespace unseen::cuboids
