// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/pose_cost.h"

namespace unseen::collision {

/// An orientation (principal axes to camera) that agrees with one silhouette.
struct PoseCandidate {
  Quat q = Quat::Identity();
  double cost = 0;  ///< χ²
};

/// The lowest minima of the silhouette's cost among all rotations, best first, at most `count`; alike ones once.
std::vector<PoseCandidate> pose_candidates(const SpinBody& body, const Camera& camera, const Look& look, std::size_t count);

/// The candidate from `start` by a few steps of Levenberg and Marquardt.
PoseCandidate refined_pose(const SpinBody& body, const Camera& camera, const Look& look, const Quat& start);

}  // namespace unseen::collision
