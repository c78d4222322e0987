// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>

#include "collision/solve/contact.h"
#include "collision/solve/rotation.h"

namespace unseen::collision {

/// The contact's normal at the bodies' places and orientations and the vertical, with its derivatives.
template <class T>
Vec3T<T> normal_by(const ContactLaw& law, const std::array<Vec3T<T>, 2>& p, const std::array<QuatT<T>, 2>& q, const Vec3T<T>& down) {
  const Vec3T<T> a = law.a.cast<T>(), b = law.b.cast<T>();
  switch (law.kind) {
    case ContactLaw::Kind::constant: return a;
    case ContactLaw::Kind::level: return -down;
    case ContactLaw::Kind::face_a: return -(q[0] * a);
    case ContactLaw::Kind::face_b: return q[1] * b;
    case ContactLaw::Kind::edges: return ((q[0] * a).cross(q[1] * b) * T(law.sign)).normalized();
    case ContactLaw::Kind::centers: break;
  }
  Vec3T<T> off = p[0] + q[0] * a - p[1] - q[1] * b;
  if (law.edge.squaredNorm() > 0.0) {
    const Vec3T<T> along = (law.a.squaredNorm() > 0.0 ? q[0] : q[1]) * law.edge.cast<T>();
    off -= along * along.dot(off);
  }
  return off.normalized();
}

}  // namespace unseen::collision
