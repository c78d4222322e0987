// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>

#include "collision/solve/rotation.h"

namespace unseen::collision {

template <class T>
struct PointState {
  Vec3T<T> p, v;  ///< m, m/s
};

/// Free flight from `start` for `dt` seconds (either way) under the acceleration `g`, with air drag `drag`·|v|·v (1/m).
template <class T>
PointState<T> fly(const PointState<T>& start, const Vec3T<T>& g, const T& drag, const T& dt) {
  if (value_of(drag) == 0.0) return {start.p + start.v * dt + g * (dt * dt * 0.5), start.v + g * dt};
  using std::sqrt;
  constexpr double kStep = 0.02;  // s; the error of a step is far below a micrometre at sports speeds
  const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(value_of(dt)) / kStep)), 1, 1000);
  const T step = dt / static_cast<double>(steps);
  const auto acceleration = [&](const Vec3T<T>& v) -> Vec3T<T> { return g - v * (drag * sqrt(v.squaredNorm() + 1e-12)); };
  PointState<T> s = start;
  for (int i = 0; i < steps; ++i) {
    const Vec3T<T> a1 = acceleration(s.v), a2 = acceleration(s.v + a1 * (step * 0.5));
    const Vec3T<T> a3 = acceleration(s.v + a2 * (step * 0.5)), a4 = acceleration(s.v + a3 * step);
    s.p += s.v * step + (a1 + a2 + a3) * (step * step * (1.0 / 6.0));
    s.v += (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (step * (1.0 / 6.0));
  }
  return s;
}

}  // namespace unseen::collision
