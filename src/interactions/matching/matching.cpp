// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/matching.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "unseen/core/quantile.h"

namespace unseen::interactions {
namespace {

double median_depth(const std::vector<const Sight*>& sights) {
  constexpr double kUsual = 4;  // m
  std::vector<double> depths;
  for (const Sight* sight : sights)
    if (sight->depth > 0) depths.push_back(sight->depth);
  if (depths.empty()) return kUsual;
  return median(std::move(depths));
}

/// The fewest frames between neighbouring sights from `first` to `last`; 0 without neighbours.
int least_gap(const std::vector<Sight>& sights, int first, int last) {
  const auto by_frame = [](const Sight& s, int f) { return s.frame < f; };
  int least = 0;
  for (auto at = std::lower_bound(sights.begin(), sights.end(), first, by_frame); at != sights.end() && at + 1 != sights.end() && (at + 1)->frame <= last; ++at)
    least = least == 0 ? (at + 1)->frame - at->frame : std::min(least, (at + 1)->frame - at->frame);
  return least;
}

/// The sight nearest to a frame, of two the earlier one; none if there are no sights.
const Sight* nearest(const std::vector<Sight>& sights, int frame) {
  const auto after = std::lower_bound(sights.begin(), sights.end(), frame, [](const Sight& s, int f) { return s.frame < f; });
  if (after == sights.begin()) return sights.empty() ? nullptr : &*after;
  const auto before = after - 1;
  return after == sights.end() || frame - before->frame <= after->frame - frame ? &*before : &*after;
}

constexpr double kSigma = 0.12;  // m at the glance's depth: beyond it a joint counts less and less

/// Normal equations of the robust distances by (θ, x, y), their robust cost and the sum of their weights.
struct Normal {
  Mat3 hessian = Mat3::Zero();
  Vec3 gradient = Vec3::Zero();
  double cost = 0, weight = 0;
};

void add_joint(Normal& normal, const Vec3& placed, const Placement& placement, const Vec2& seen, double confidence, double depth, const View& view) {
  const Mat3 turn = view.T_world_camera.rotation.transpose();
  const Vec3 q = turn * (placed - view.center());
  constexpr double kNearest = 0.2;  // m
  if (q.z() < kNearest) {
    normal.cost += confidence * kSigma * kSigma * std::log1p(100.0);
    normal.weight += confidence;
    return;
  }
  const Vec2 residual = depth * (q.head<2>() / q.z() - seen);
  Eigen::Matrix<double, 2, 3> project;
  project << 1, 0, -q.x() / q.z(), 0, 1, -q.y() / q.z();
  project *= depth / q.z();
  Mat3 move = Mat3::Zero();  // of the placed point by (θ, x, y)
  move.col(0) = Vec3(-(placed.y() - placement.position.y()), placed.x() - placement.position.x(), 0);
  move.col(1) = Vec3::UnitX();
  move.col(2) = Vec3::UnitY();
  const Eigen::Matrix<double, 2, 3> jacobian = project * turn * move;
  const double off = residual.squaredNorm() / (kSigma * kSigma), weight = confidence / (1 + off);
  normal.hessian += weight * jacobian.transpose() * jacobian;
  normal.gradient += weight * jacobian.transpose() * residual;
  normal.cost += confidence * kSigma * kSigma * std::log1p(off);
  normal.weight += confidence;
}

Normal normal_of(const Glance& glance, const Scenelet& scenelet, const Placement& placement, const View& view) {
  Normal normal;
  for (std::size_t i = 0; i < glance.sights.size(); ++i) {
    const auto pose = pose_at(scenelet, glance.offsets[i]);
    if (!pose) continue;
    const Sight& sight = *glance.sights[i];
    const Pose placed = placement * *pose;
    for (int k = 0; k < kJoints; ++k) {
      if (sight.confidence[k] < kSeen) continue;
      const Camera& c = view.camera;
      const Vec2 seen((sight.pixels(0, k) - c.cx) / c.fx, (sight.pixels(1, k) - c.cy) / c.fy);
      add_joint(normal, placed.col(k), placement, seen, sight.confidence[k], glance.depth, view);
    }
  }
  return normal;
}

}  // namespace

Glance glance_at(const std::vector<Sight>& sights, int frame, double fps, double half, double step) {
  Glance glance;
  glance.center = frame;
  const int reach = static_cast<int>(std::lround(half * fps)), stride = std::max(1, static_cast<int>(std::lround(step * fps)));
  const int slack = std::min(stride, least_gap(sights, frame - reach, frame + reach)) / 2;
  for (int time = frame - reach / stride * stride; time <= frame + reach; time += stride) {
    const Sight* sight = nearest(sights, time);
    if (sight == nullptr || std::abs(sight->frame - time) > slack || std::abs(sight->frame - frame) > reach) continue;
    if (!glance.sights.empty() && glance.sights.back() == sight) continue;
    glance.sights.push_back(sight);
    glance.offsets.push_back((sight->frame - frame) / fps);
  }
  glance.depth = median_depth(glance.sights);
  return glance;
}

std::optional<Pose> pose_at(const Scenelet& scenelet, double offset) {
  constexpr double kRounding = 1e-6;
  const double at = scenelet.middle + offset * scenelet.fps;
  const double last = static_cast<double>(scenelet.poses.size()) - 1;
  if (at < -kRounding || at > last + kRounding) return std::nullopt;
  const std::size_t below = static_cast<std::size_t>(std::clamp(at, 0.0, last));
  const std::size_t above = std::min(below + 1, scenelet.poses.size() - 1);
  const double share = std::clamp(at - static_cast<double>(below), 0.0, 1.0);
  return Pose((1 - share) * scenelet.poses[below] + share * scenelet.poses[above]);
}

PlacementCost cost_of(const Glance& glance, const Scenelet& scenelet, const Vec3& camera, double& weight) {
  PlacementCost cost;
  weight = 0;
  for (std::size_t i = 0; i < glance.sights.size(); ++i) {
    const auto pose = pose_at(scenelet, glance.offsets[i]);
    if (!pose) continue;
    for (int k = 0; k < kJoints; ++k) {
      if (glance.sights[i]->confidence[k] < kSeen) continue;
      cost.add(pose->col(k), camera, glance.sights[i]->information[k]);
      weight += glance.sights[i]->confidence[k];
    }
  }
  return cost;
}

void refine(Match& match, const Glance& glance, const Scenelet& scenelet, const View& view) {
  constexpr int kRounds = 6;
  double damping = 1e-3;
  Normal at = normal_of(glance, scenelet, match.placement, view);
  for (int round = 0; round < kRounds; ++round) {
    const Mat3 damped = at.hessian + damping * Mat3(at.hessian.diagonal().asDiagonal()) + 1e-9 * Mat3::Identity();
    const Vec3 step = -solve_symmetric(damped, at.gradient);
    Placement moved = match.placement;
    moved.angle += step[0];
    moved.position += Vec3(step[1], step[2], 0);
    const Normal next = normal_of(glance, scenelet, moved, view);
    if (next.cost < at.cost) {
      match.placement = moved;
      at = next;
      damping *= 0.1;
    } else {
      damping *= 10;
    }
  }
  match.error = at.weight > 0 ? at.cost / at.weight : 0;
}

}  // namespace unseen::interactions
