// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <ceres/jet.h>

namespace unseen::collision {

/// The number itself, of a double or of one that carries derivatives.
inline double value_of(double x) { return x; }
template <int N>
double value_of(const ceres::Jet<double, N>& x) {
  return x.a;
}

}  // namespace unseen::collision
