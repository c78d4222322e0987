// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/pose_candidates.h"

#include <algorithm>

#include "collision/orientations/views.h"
#include "collision/solve/rotation.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr int kViewsTried = 512, kTurns = 32;
constexpr double kApart = 0.35;    // rad, of starts
constexpr double kSame = 0.1;      // rad, of minima
constexpr int kRefinements = 6;

/// The grid by support functions: a turn about the view ray shifts the directions, so one projection serves kTurns orientations.
std::vector<PoseCandidate> on_grid(const SpinBody& body, const Camera& camera, const Look& look) {
  static_assert(kTurns == kDirections);
  const std::vector<Quat> grid = rotation_grid(kViewsTried, kTurns);
  const Quat to_ray = turn_between(Vec3::UnitZ(), look.center);
  Eigen::Matrix<double, kDirections, kTurns> turned;
  std::vector<PoseCandidate> all(grid.size());
  for (int v = 0; v < kViewsTried; ++v) {
    const Quat& first = grid[static_cast<std::size_t>(v * kTurns)];
    const Support h = support_of(projected(body.corners, to_ray * first, look.center, camera), look.pixel);
    for (int t = 0; t < kTurns; ++t) {
      for (int i = 0; i < kDirections; ++i) turned(i, t) = h[(i - t + kDirections) % kDirections] - look.seen[i];
    }
    const Eigen::Matrix<double, kDirections, kTurns> white = look.whitening.triangularView<Eigen::Lower>() * turned;
    for (int t = 0; t < kTurns; ++t) {
      const auto i = static_cast<std::size_t>(v * kTurns + t);
      all[i] = {to_ray * grid[i], white.col(t).squaredNorm()};
    }
  }
  return all;
}

}  // namespace

PoseCandidate refined_pose(const SpinBody& body, const Camera& camera, const Look& look, const Quat& start) {
  constexpr double kStep = 1e-4;
  Quat q = start;
  Support r = silhouette_residual(body, camera, look, q);
  double cost = r.squaredNorm(), damping = 1e-2;
  for (int step = 0; step < kRefinements; ++step) {
    Eigen::Matrix<double, kDirections, 3> jacobian;
    for (int i = 0; i < 3; ++i)
      jacobian.col(i) = (silhouette_residual(body, camera, look, rotation_by<double>(kStep * Vec3::Unit(i)) * q) - r) / kStep;
    Mat3 normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-6;
    const Vec3 move = -solve_symmetric(normal, jacobian.transpose() * r);
    const Quat next = (rotation_by<double>(move.norm() > 0.3 ? Vec3(0.3 * move.normalized()) : move) * q).normalized();
    const Support there = silhouette_residual(body, camera, look, next);
    if (there.squaredNorm() < cost) {
      q = next, r = there, cost = there.squaredNorm(), damping *= 0.2;
    } else {
      damping = std::max(10.0 * damping, 1e-2);
    }
  }
  return {q, cost};
}

std::vector<PoseCandidate> pose_candidates(const SpinBody& body, const Camera& camera, const Look& look, std::size_t count) {
  std::vector<PoseCandidate> all = on_grid(body, camera, look);
  const auto better = [](const PoseCandidate& a, const PoseCandidate& b) { return a.cost < b.cost; };
  const auto alike = [&](const std::vector<PoseCandidate>& kept, const Quat& q, double within) {
    const auto near = [&](const PoseCandidate& k) { return angle_between(q, k.q, body.symmetry.turns) < within; };
    return std::any_of(kept.begin(), kept.end(), near);
  };
  std::sort(all.begin(), all.end(), better);
  std::vector<PoseCandidate> starts, minima, few;
  for (const PoseCandidate& c : all) {
    if (starts.size() >= 3 * count) break;
    if (!alike(starts, c.q, kApart)) starts.push_back(c);
  }
  for (const PoseCandidate& c : starts) minima.push_back(refined_pose(body, camera, look, c.q));
  std::sort(minima.begin(), minima.end(), better);
  for (const PoseCandidate& c : minima) {
    if (few.size() >= count) break;
    if (!alike(few, c.q, kSame)) few.push_back(c);
  }
  return few;
}

}  // namespace unseen::collision
