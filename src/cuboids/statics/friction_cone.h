// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// The force in the friction cone {|f_t| ≤ μ f_n} that is nearest to a given one, and how it changes with that one
/// (an element of the generalised Jacobian, symmetric).
struct ConeProjection {
  Vec3 force = Vec3::Zero();
  Mat3 derivative = Mat3::Zero();
  bool is_zero = true;
};

inline ConeProjection project_to_cone(const Vec3& force, const Vec3& normal, double friction) {
  const double along = force.dot(normal);
  const Vec3 across = force - along * normal;
  const double slide = across.norm();
  if (along > 0.0 && slide <= friction * along) return {force, Mat3::Identity(), false};
  const double pressed = (along + friction * slide) / (1.0 + friction * friction);
  if (pressed <= 0.0) return {};
  const Vec3 direction = slide > 0.0 ? Vec3(across / slide) : Vec3(Vec3::Zero());
  const Vec3 edge = normal + friction * direction;  // of the cone
  Mat3 derivative = edge * edge.transpose() / (1.0 + friction * friction);
  if (friction > 0.0) {
    const Mat3 around = Mat3::Identity() - normal * normal.transpose() - direction * direction.transpose();
    derivative += friction * pressed / slide * around;
  }
  return {pressed * edge, derivative, false};
}

}  // namespace unseen::cuboids
