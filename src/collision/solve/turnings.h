// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/problem.h"
#include "collision/solve/touching_fit.h"

namespace unseen::collision {

/// A body's turning through the impact: at it, and the lever (across the impulse) that the change of momentum asks for.
struct ImpactTurning {
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero(), h_after = Vec3::Zero(), lever = Vec3::Zero();
  bool has_lever = false;
  double cost = 0;
  Mat3 spread = Mat3::Zero(), spread_after = Mat3::Zero();  // covariances of h and h_after

  TouchingFit::Turn turn() const {
    if (!has_lever) return {};
    return {h_after - h, Mat3((spread + spread_after).inverse())};
  }
};

/// Pairs of guesses before and after, ranked by how well they meet at the impact. `impulse` is the body's own, per its mass.
std::vector<ImpactTurning> turnings(const Problem& problem, int body, double time, const Vec3& impulse);

/// Both bodies' turnings.
struct TurningPair {
  ImpactTurning a, b;
  double cost() const { return a.cost + b.cost; }
};

/// How both bodies may have turned, the best first; noisy orientations are tried shaken as well, `shakes` times, since a small turn may decide
/// where the shapes touch. `base` has the impact's time, impulse and mass ratio.
std::vector<TurningPair> turning_pairs(const Problem& problem, const State& base, int shakes);

}  // namespace unseen::collision
