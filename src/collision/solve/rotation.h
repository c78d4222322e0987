// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "collision/solve/scalar.h"

namespace unseen::collision {

template <class T>
using Vec3T = Eigen::Matrix<T, 3, 1>;
template <class T>
using QuatT = Eigen::Quaternion<T>;

/// The rotation by the vector `r` (axis times angle, rad); smooth at zero.
template <class T>
QuatT<T> rotation_by(const Vec3T<T>& r) {
  using std::cos, std::sin, std::sqrt;
  const T square = r.squaredNorm();
  if (value_of(square) < 1e-12) return QuatT<T>(T(1.0) - square / 8.0, r.x() * (0.5 - square / 48.0), r.y() * (0.5 - square / 48.0), r.z() * (0.5 - square / 48.0));
  const T angle = sqrt(square), s = sin(angle * 0.5) / angle;
  return QuatT<T>(cos(angle * 0.5), r.x() * s, r.y() * s, r.z() * s);
}

/// The rotation vector of `q`, of at most π.
template <class T>
Vec3T<T> rotation_vector(const QuatT<T>& q) {
  using std::atan2, std::sqrt;
  const T sign = value_of(q.w()) < 0.0 ? T(-1.0) : T(1.0);
  const Vec3T<T> v = q.vec() * sign;
  const T w = q.w() * sign, square = v.squaredNorm();
  if (value_of(square) < 1e-16) return v * (T(2.0) / w);
  const T length = sqrt(square);
  return v * (T(2.0) * atan2(length, w) / length);
}

/// Angular velocity of a body with angular momentum `h`; both of unit mass, in the outer frame. `q` maps the principal axes to it.
template <class T>
Vec3T<T> angular_velocity(const QuatT<T>& q, const Vec3T<T>& h, const Eigen::Vector3d& inertia) {
  const Vec3T<T> inner = q.conjugate() * h;
  return q * Vec3T<T>(inner.x() / inertia.x(), inner.y() / inertia.y(), inner.z() / inertia.z());
}

/// Where a torque-free body has turned to after `dt` (s): steps of at most 0.4 rad and fourth order by Magnus's series (Iserles et al., "Lie-group
/// methods", 2000), which keep the momentum; exact for a sphere.
Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& h, const Eigen::Vector3d& inertia, double dt);

/// Where a torque-free body has turned to, and how that turns (a rotation vector) with the momentum.
struct TurnedEnd {
  Eigen::Quaterniond q;
  Eigen::Matrix3d along_h;
};

/// turned() for several times (s); each is reached from the one before, so they had better lead away from 0. Derivatives only if asked for.
std::vector<TurnedEnd> turned_through(const Eigen::Quaterniond& q, const Eigen::Vector3d& h, const Eigen::Vector3d& inertia,
                                      const std::vector<double>& times, bool derivatives);

}  // namespace unseen::collision
