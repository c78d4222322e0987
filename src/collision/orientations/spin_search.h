// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/pose_cost.h"

namespace unseen::collision {

/// A torque-free rotation: orientation (principal axes to camera) and momentum (of unit mass, camera axes) at a time.
struct Turning {
  double time = 0;  ///< s
  Quat q = Quat::Identity();
  Vec3 h = Vec3::Zero();
  double cost = 0;  ///< robust χ²: of the silhouettes, in the end also of the colours
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();  ///< of the turn of q (rad) and of h, camera axes
};

/// Its orientations at the looks' times, which ascend.
std::vector<Quat> orientations_of(const Turning& turning, const SpinBody& body, const std::vector<Look>& looks);

/// The same motion, described at another time.
Turning at_time(const Turning& turning, const SpinBody& body, double time);

/// Lowest minima of the silhouettes' cost summed over all looks, best first, at most `count`; those that differ by a symmetry of the body
/// once, mirrored ones (the reversal in depth that silhouettes hardly tell) apart.
std::vector<Turning> find_turnings(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t count);

/// Sorts by cost, and keeps the best of those that are alike between two times but for the body's symmetries, at most `count`.
void keep_best(std::vector<Turning>& all, const SpinBody& body, double from, double to, std::size_t count);

/// Robust χ² of the silhouettes of looks [begin, end).
double silhouette_cost(const Turning& turning, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks,
                       std::size_t begin, std::size_t end);

/// The minimum nearest to `start` over looks [begin, end).
Turning refined(const Turning& start, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin,
                std::size_t end, int steps);

}  // namespace unseen::collision
