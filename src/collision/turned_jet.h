// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>

#include "collision/rotation.h"

namespace unseen::collision {

/// turned(), with derivatives taken through its eight arguments only: as many as the caller carries would make each step expensive.
template <class T>
QuatT<T> turned_lean(const QuatT<T>& q, const Vec3T<T>& h, const Eigen::Vector3d& inertia, const T& dt) {
  if constexpr (std::is_same_v<T, double>) {
    return turned<double>(q, h, inertia, dt);
  } else {
    using Lean = ceres::Jet<double, 8>;
    const std::array<const T*, 8> in = {&q.w(), &q.x(), &q.y(), &q.z(), &h.x(), &h.y(), &h.z(), &dt};
    const auto lean = [&](int i) { return Lean(value_of(*in[i]), i); };
    const QuatT<Lean> end = turned<Lean>(QuatT<Lean>(lean(0), lean(1), lean(2), lean(3)), Vec3T<Lean>(lean(4), lean(5), lean(6)), inertia, lean(7));
    const auto chained = [&](const Lean& value) {
      T result(value.a);
      for (int i = 0; i < 8; ++i) result.v += value.v[i] * in[i]->v;
      return result;
    };
    return QuatT<T>(chained(end.w()), chained(end.x()), chained(end.y()), chained(end.z()));
  }
}

}  // namespace unseen::collision
