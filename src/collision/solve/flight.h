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

/// What slows a body: the air, by air·|v|·v, or what it slides on, evenly until it lies still.
struct Resistance {
  double air = 0;    ///< 1/m
  double table = 0;  ///< m/s²
};

/// Motion on a level table from `start` for `dt` seconds (either way) that friction slows by `slowing` m/s².
template <class T>
PointState<T> slide(const PointState<T>& start, double slowing, const T& dt) {
  using std::sqrt;
  constexpr double kStill = 1e-6;  // m²/s²: what hardly moves has no direction
  const T speed = sqrt(start.v.squaredNorm() + kStill), until = speed / slowing, time = value_of(dt) < value_of(until) ? dt : until, lost = time * slowing / speed;
  return {start.p + start.v * (time * (1.0 - 0.5 * lost)), start.v * (1.0 - lost)};
}

/// Free flight from `start` for `dt` seconds (either way) under the acceleration `g`; what a table slows has none.
template <class T>
PointState<T> fly(const PointState<T>& start, const Vec3T<T>& g, const Resistance& resistance, const T& dt) {
  using std::sqrt;
  if (resistance.table > 0.0) return slide(start, resistance.table, dt);
  if (resistance.air == 0.0) return {start.p + start.v * dt + g * (dt * dt * 0.5), start.v + g * dt};
  constexpr double kStep = 0.02;  // s; the error of a step is far below a micrometre at sports speeds
  const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(value_of(dt)) / kStep)), 1, 1000);
  const T step = dt / static_cast<double>(steps);
  const auto acceleration = [&](const Vec3T<T>& v) -> Vec3T<T> { return g - v * (resistance.air * sqrt(v.squaredNorm() + 1e-12)); };
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
