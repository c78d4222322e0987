// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/synth/synth_body.h"

namespace unseen::collision {

/// A body's motion at one instant; world coordinates, but for the angular velocity.
struct SynthState {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 w = Vec3::Zero();  ///< angular velocity in the body's (file's) axes, rad/s

  SynthPose pose() const { return {p, q}; }
};

/// A body with its mass. No inverse of anything: fixed partners are no movers.
struct SynthMover {
  SynthBody body;
  double mass = 1;  ///< with that of the first body as 1
  double drag = 0;  ///< ρ Cd A / (2 mass), 1/m: deceleration a speed squared

  Vec3 momentum(const SynthState& s) const { return mass * (s.q * (body.inertia * s.w)); }  ///< angular, about the centre
  double energy(const SynthState& s) const { return 0.5 * mass * (s.v.squaredNorm() + s.w.dot(body.inertia * s.w)); }
};

/// Free flight over `dt` (of either sign): the parabola in closed form, or with drag by Runge–Kutta; rotation by Runge–Kutta of
/// Euler's equations I ẇ = (I w) × w and of q̇ = ½ q w, steps of at most 0.1 ms.
SynthState fly(const SynthMover& mover, const SynthState& start, const Vec3& gravity, double dt);

/// A point contact as it happened.
struct SynthHit {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< normal from the second body to the first
  Vec3 impulse = Vec3::Zero();                        ///< on the first
  double approach = 0;                                ///< normal speed before, positive, m/s
  std::optional<double> tangential;                   ///< restitution across the normal: −1 frictionless, 0 stuck
};

/// Rigid impact at a point: Newton's restitution along the normal, Coulomb's friction across (it sticks if the impulse that ends the
/// sliding lies in the cone, else it slides on in the direction it had). `b` null: something fixed. Changes the states.
/// False, and nothing changed, if the bodies do not approach, or the sliding would turn round or energy grow.
bool collide(const SynthMover& a, SynthState& sa, const SynthMover* b, SynthState* sb, double restitution, double friction,
             SynthHit& hit);

}  // namespace unseen::collision
