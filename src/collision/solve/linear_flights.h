// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// A body's place at the impact and its velocities just before and after, in camera coordinates, and ½ χ² of its centres near there: with y =
/// (p, v_before, v_after, the impact's delay in s), that is ½ yᵀ·normal·y − right·y and a constant.
struct LinearFlight {
  static constexpr int kUnknowns = 10;
  Vec3 p, v_before, v_after;
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
  Eigen::Matrix<double, kUnknowns, 1> right;
};

/// From linear equations: fx X − (u − cx) Z = 0 and the like, which known gravity makes inhomogeneous, and the depth from sizes. Robust by
/// reweighting. Nothing if the points do not determine it.
std::optional<LinearFlight> linear_flight(const Problem& problem, int body, double time);

constexpr double kMostMisfit = 4.5;  ///< ½ χ² of a sighting that is off

/// ½ χ² of a body's sightings about its flight with an impact at `time`; each counts for at most kMostMisfit.
double misfit(const Problem& problem, const LinearFlight& flight, int body, double time);

}  // namespace unseen::collision
