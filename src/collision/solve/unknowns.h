// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>

#include <array>
#include <vector>

#include "collision/solve/contact_law.h"
#include "collision/solve/flight.h"
#include "collision/solve/problem.h"

namespace unseen::collision {

/// Where each unknown lies in the solver's parameters. All are steps from a reference state, so that all are plain numbers.
enum Unknown : int {
  kTime = 0,     // s
  kDown = 1,     // rad, two tilts
  kP = 3,        // m, a then b
  kV = 9,        // m/s
  kTurn = 15,    // rad, rotation vectors
  kH = 21,       // m²/s, unit-mass momenta
  kX = 27,       // m
  kImpulse = 30,  // m/s
  kLogMass = 33,  // logarithm of the mass ratio
  kVAfter = 34,  // soft form
  kHAfter = 40,
  kUnknowns = 46
};

/// The state as a function of the unknowns.
template <class T>
struct StateT {
  T time, mass_ratio, inverse_mass;
  Vec3T<T> down;
  std::array<Vec3T<T>, 2> p, v, h, v_after, h_after;
  std::array<QuatT<T>, 2> q;
  std::array<Vec3T<T>, 2> turn;  ///< 0, with the derivatives of q as a rotation
  Vec3T<T> x, impulse;
};

/// Unpacks `u` (kUnknowns numbers, steps from `reference`). In the exact form momentum is conserved by construction (thesis Eqs. 5.12, 5.13).
template <class T>
StateT<T> unpack(const Problem& problem, const State& reference, const T* u) {
  const auto vec = [u](int at) { return Vec3T<T>(u[at], u[at + 1], u[at + 2]); };
  StateT<T> s;
  s.time = u[kTime] + reference.time;
  const Eigen::Vector3d e1 = any_orthogonal(reference.down), e2 = reference.down.cross(e1);
  s.down = (reference.down.cast<T>() + e1.cast<T>() * u[kDown] + e2.cast<T>() * u[kDown + 1]).normalized();
  using std::exp;
  s.mass_ratio = exp(u[kLogMass]) * reference.mass_ratio;
  s.inverse_mass = problem.fixed ? T(0.0) : T(1.0) / s.mass_ratio;
  s.x = reference.x.cast<T>() + vec(kX);
  s.impulse = reference.impulse.cast<T>() + vec(kImpulse);
  const bool of_centres = problem.is_of_centres();
  for (int o = 0; o < 2; ++o) {
    s.p[o] = reference.p[o].cast<T>() + vec(kP + 3 * o);
    s.v[o] = reference.v[o].cast<T>() + vec(kV + 3 * o);
    s.h[o] = reference.h[o].cast<T>() + vec(kH + 3 * o);
    s.q[o] = rotation_by<T>(vec(kTurn + 3 * o)) * reference.q[o].cast<T>();
    s.turn[o] = (s.q[o] * QuatT<T>(T(value_of(s.q[o].w())), T(-value_of(s.q[o].x())), T(-value_of(s.q[o].y())), T(-value_of(s.q[o].z())))).vec() * T(2.0);
    if (problem.terms.soft) {
      s.v_after[o] = reference.v_after[o].cast<T>() + vec(kVAfter + 3 * o);
      s.h_after[o] = reference.h_after[o].cast<T>() + vec(kHAfter + 3 * o);
    } else {
      const T share = o == 0 ? T(1.0) : -s.inverse_mass;
      s.v_after[o] = s.v[o] + s.impulse * share;
      s.h_after[o] = s.h[o];
      if (!of_centres) s.h_after[o] += (s.x - s.p[o]).cross(s.impulse) * share;
    }
  }
  return s;
}

/// The state at the unknowns' values.
State state_at(const Problem& problem, const State& reference, const double* u);

/// Velocity of the body's point at the contact, before or after the impact; of its centre, if the impact is one of centres.
template <class T>
Vec3T<T> contact_velocity(const Problem& problem, const StateT<T>& s, int o, bool after) {
  if (o == 1 && problem.fixed) return Vec3T<T>(T(0.0), T(0.0), T(0.0));
  const Vec3T<T>& v = after ? s.v_after[o] : s.v[o];
  if (problem.is_of_centres()) return v;
  const Vec3T<T> omega = angular_velocity<T>(s.q[o], after ? s.h_after[o] : s.h[o], problem.solids[o].mass.inertia);
  return v + omega.cross(s.x - s.p[o]);
}

/// The contact's normal, from b to a: that of the shapes, or the impulse's direction.
template <class T>
Vec3T<T> contact_normal(const State& reference, const StateT<T>& s) {
  if (reference.law) return normal_by<T>(*reference.law, s.p, s.q, s.down);
  using std::sqrt;
  return s.impulse / sqrt(s.impulse.squaredNorm() + 1e-20);
}

/// Coefficient of restitution (thesis Eq. 5.14).
template <class T>
T restitution(const Problem& problem, const State& reference, const StateT<T>& s) {
  const Vec3T<T> n = contact_normal<T>(reference, s);
  const T before = (contact_velocity<T>(problem, s, 0, false) - contact_velocity<T>(problem, s, 1, false)).dot(n);
  const T after = (contact_velocity<T>(problem, s, 0, true) - contact_velocity<T>(problem, s, 1, true)).dot(n);
  return -after / (value_of(before) < -1e-6 ? before : T(-1e-6));
}

/// Kinetic energy with the first body's mass as 1 (Eq. 5.20 with the halves it drops).
template <class T>
T kinetic_energy(const Problem& problem, const StateT<T>& s, bool after) {
  T energy(0.0);
  for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
    const Vec3T<T>&v = after ? s.v_after[o] : s.v[o], &h = after ? s.h_after[o] : s.h[o];
    const T mass = o == 0 ? T(1.0) : s.mass_ratio;
    energy += mass * 0.5 * (v.squaredNorm() + h.dot(angular_velocity<T>(s.q[o], h, problem.solids[o].mass.inertia)));
  }
  return energy;
}

/// Where body `o` is at `time`, on the flight before or after the impact.
template <class T>
Vec3T<T> position_at(const Problem& problem, const StateT<T>& s, int o, bool after, double time) {
  if ((o == 1 && problem.fixed) || !problem.flies(o, after)) return s.p[o];
  const PointState<T> start{s.p[o], after ? s.v_after[o] : s.v[o]};
  return fly<T>(start, s.down * T(problem.gravity), problem.resistance(o), T(time) - s.time).p;
}

/// How body `o` is turned at `time`.
Quat orientation_at(const Problem& problem, const State& state, int o, bool after, double time);

/// A state with its functions of the unknowns filled in.
StateT<double> values_of(const Problem& problem, const State& state);

/// A number with its derivatives along all unknowns.
using Wide = ceres::Jet<double, kUnknowns>;

/// A place, and with its derivatives.
struct SeenPlace {
  Vec3 p;
  Vec3T<Wide> wide;
};

/// The same with derivatives.
StateT<Wide> wide_values_of(const Problem& problem, const State& state);

/// The coefficient of restitution of a state, within its bounds 0 and 1.
inline double bounded_restitution(const Problem& problem, const State& state) {
  return std::clamp(restitution<double>(problem, state, values_of(problem, state)), 0.0, 1.0);
}

}  // namespace unseen::collision
