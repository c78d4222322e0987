// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kGoodResidual = 1e-4;
constexpr int kSteps = 12;
constexpr double kMostShrink = 0.3;  // of a size, by one face
constexpr double kProbe = 1e-4;  // m, of the derivative

/// An arrangement with its balance.
struct State {
  Arrangement arrangement;
  std::vector<Touch> touches;
  Structure structure;
  Balance balance;
};

State state_of(const Problem& problem, const std::vector<char>& held, Arrangement arrangement) {
  State s{std::move(arrangement), {}, {}, {}};
  s.touches = touching_pairs(problem, s.arrangement);
  s.structure = structure_of(problem, s.arrangement, s.touches, held);
  s.balance = balance(s.structure.bodies, s.structure.contacts);
  return s;
}

/// Sum over bodies of the squared unbalanced force and torque, scaled, if given forces act on a structure.
double energy(const Structure& structure, const std::vector<Vec3>& forces) {
  std::vector<Vec3> force(structure.bodies.size()), torque(structure.bodies.size(), Vec3::Zero());
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = Vec3(0, 0, -structure.bodies[i].weight);
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

Arrangement with_face(const Problem& problem, Arrangement a, int cuboid, int face, double move) {
  const double size = 2.0 * problem.cuboids[cuboid].initial.half_size[face / 2];
  a.extension[cuboid][face] = std::max(a.extension[cuboid][face] + move, -kMostShrink * size);
  a.boxes[cuboid] = extended(problem.cuboids[cuboid].initial, a.extension[cuboid]);
  a.solids[cuboid] = solid_of(a.boxes[cuboid]);
  return a;
}

/// Derivative of the energy by each face, the forces kept (they are at their best, so theirs does not count).
std::vector<Extension> gradient(const Problem& problem, const std::vector<char>& held, const State& s, double energy_now) {
  std::vector<Extension> out(problem.cuboids.size(), Extension{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int body = problem.supports_count() + static_cast<int>(i);
    const int group = s.structure.group[body];
    if (s.structure.bodies[group].is_static || s.balance.motion[group].norm() < kGoodResidual) continue;
    for (int face = 0; face < 6; ++face) {
      const Arrangement probe = with_face(problem, s.arrangement, static_cast<int>(i), face, kProbe);
      const Structure there = structure_of(problem, probe, touching_pairs(problem, probe), held);
      if (there.contacts.size() != s.structure.contacts.size()) continue;
      out[i][face] = (energy(there, s.balance.forces) - energy_now) / kProbe;
    }
  }
  return out;
}

}  // namespace

void lower_residual(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  State now = state_of(problem, held, arrangement);
  const std::vector<Extension> start = arrangement.extension;
  for (int step = 0; step < kSteps && now.balance.residual > kGoodResidual; ++step) {
    context.check();
    const double before = energy(now.structure, now.balance.forces);
    const std::vector<Extension> slope = gradient(problem, held, now, before);
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
          // Newton's step along the gradient for an energy whose least is 0; faces that were not moved stay within noise.
          const bool hidden = start[i][face] > problem.tolerance[i];
          const double freedom = hidden ? 4.0 * problem.tolerance[i] : 0.5 * problem.tolerance[i];
          const double wanted = now.arrangement.extension[i][face] - share * 2.0 * before / squared * slope[i][face];
          const double allowed = std::clamp(wanted, start[i][face] - freedom, start[i][face] + freedom);
          next = with_face(problem, std::move(next), static_cast<int>(i), face, allowed - next.extension[i][face]);
        }
      close_contacts(problem, touching_pairs(problem, next), next);
      if (penetrates(problem, next)) continue;
      State there = state_of(problem, held, std::move(next));
      if (energy(there.structure, there.balance.forces) < 0.98 * before) {
        now = std::move(there);
        better = true;
      }
    }
    if (!better) break;
  }
  arrangement = std::move(now.arrangement);
}

}  // namespace unseen::cuboids
