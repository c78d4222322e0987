// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/synth/synth_motion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr double kStep = 1e-4;  // s

struct Turn {
  Eigen::Vector4d q;
  Vec3 w;
};

Turn operator+(const Turn& a, const Turn& b) { return {a.q + b.q, a.w + b.w}; }
Turn operator*(double s, const Turn& a) { return {s * a.q, s * a.w}; }

/// One step of the classical Runge–Kutta method of order 4.
template <class State, class Rate>
State runge_kutta(const State& x, double h, const Rate& rate) {
  const State k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
  return x + h / 6 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

void turn(const SynthBody& body, SynthState& s, double h, int steps) {
  const Mat3 inverse = body.inertia.inverse();
  const auto rate = [&](const Turn& t) {
    Quat q;
    q.coeffs() = t.q;
    const Quat dq = q * Quat(0, t.w.x(), t.w.y(), t.w.z());
    return Turn{0.5 * dq.coeffs(), inverse * (body.inertia * t.w).cross(t.w)};
  };
  Turn t{s.q.coeffs(), s.w};
  for (int i = 0; i < steps; ++i) {
    t = runge_kutta(t, h, rate);
    t.q.normalize();
  }
  s.q.coeffs() = t.q;
  s.w = t.w;
}

using PositionVelocity = Eigen::Matrix<double, 6, 1>;

void fall_with_drag(double drag, const Vec3& gravity, SynthState& s, double h, int steps) {
  PositionVelocity x;
  x << s.p, s.v;
  const auto rate = [&](const PositionVelocity& at) {
    const Vec3 v = at.tail<3>();
    PositionVelocity d;
    d << v, gravity - drag * v.norm() * v;
    return d;
  };
  for (int i = 0; i < steps; ++i) x = runge_kutta(x, h, rate);
  s.p = x.head<3>();
  s.v = x.tail<3>();
}

Mat3 world_inverse_inertia(const SynthMover& m, const SynthState& s) {
  const Mat3 R = s.q.toRotationMatrix();
  return R * (m.mass * m.body.inertia).inverse() * R.transpose();
}

/// What an impulse at a point changes the point's velocity by: K of Δu = K J.
Mat3 contact_matrix(const SynthMover& m, const SynthState& s, const Vec3& point) {
  const Mat3 r = cross_matrix(point - s.p);
  return Mat3::Identity() / m.mass - r * world_inverse_inertia(m, s) * r;
}

Vec3 point_velocity(const SynthState& s, const Vec3& point) { return s.v + (s.q * s.w).cross(point - s.p); }

SynthState pushed(const SynthMover& m, const SynthState& s, const Vec3& impulse, const Vec3& point) {
  SynthState after = s;
  after.v += impulse / m.mass;
  after.w += s.q.conjugate() * (world_inverse_inertia(m, s) * (point - s.p).cross(impulse));
  return after;
}

/// Impulse of a contact with relative velocity u; nothing if it slides in no constant direction.
std::optional<Vec3> contact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double restitution, double friction) {
  const double normal_speed = u.dot(n);
  const Vec3 across = u - normal_speed * n;
  const Vec3 sticking = K.inverse() * (-restitution * normal_speed * n - u);
  const double sticking_normal = sticking.dot(n);
  if (sticking_normal > 0 && (sticking - sticking_normal * n).norm() <= friction * sticking_normal) return sticking;
  const Vec3 direction = across.norm() > 1e-12 ? Vec3(n - friction * across.normalized()) : n;
  const double share = n.dot(K * direction);
  if (share <= 0) return std::nullopt;
  return Vec3(-(1 + restitution) * normal_speed / share * direction);
}

}  // namespace

SynthState fly(const SynthMover& mover, const SynthState& start, const Vec3& gravity, double dt) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(dt) / kStep)));
  SynthState s = start;
  turn(mover.body, s, dt / steps, steps);
  if (mover.drag > 0) {
    fall_with_drag(mover.drag, gravity, s, dt / steps, steps);
  } else {
    s.p += start.v * dt + 0.5 * dt * dt * gravity;
    s.v += dt * gravity;
  }
  return s;
}

bool collide(const SynthMover& a, SynthState& sa, const SynthMover* b, SynthState* sb, double restitution, double friction,
             SynthHit& hit) {
  const Vec3& n = hit.normal;
  Mat3 K = contact_matrix(a, sa, hit.point);
  Vec3 before = point_velocity(sa, hit.point);
  if (b != nullptr) {
    K += contact_matrix(*b, *sb, hit.point);
    before -= point_velocity(*sb, hit.point);
  }
  hit.approach = -before.dot(n);
  if (hit.approach <= 0) return false;
  const auto impulse = contact_impulse(K, before, n, restitution, friction);
  if (!impulse) return false;
  const SynthState a_after = pushed(a, sa, *impulse, hit.point);
  const SynthState b_after = b != nullptr ? pushed(*b, *sb, -*impulse, hit.point) : SynthState{};
  const double energy = a.energy(sa) + (b != nullptr ? b->energy(*sb) : 0.0);
  if (a.energy(a_after) + (b != nullptr ? b->energy(b_after) : 0.0) > energy * (1 + 1e-12)) return false;
  const Vec3 across = before + hit.approach * n, after = before + K * *impulse, across_after = after - after.dot(n) * n;
  const bool sticks = across_after.norm() < 1e-9;
  if (friction > 0 && !sticks && across_after.dot(across) < 0) return false;
  hit.impulse = *impulse;
  hit.tangential.reset();
  if (across.norm() > 1e-3) hit.tangential = -across_after.dot(across) / across.squaredNorm();
  sa = a_after;
  if (b != nullptr) *sb = b_after;
  return true;
}

}  // namespace unseen::collision
