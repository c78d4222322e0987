// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching.h"

#include <algorithm>
#include <cmath>

namespace unseen::interactions {

Glance glance_at(const std::vector<Sight>& sights, int frame, double fps, double half, double step) {
  Glance glance;
  glance.center = frame;
  const int reach = static_cast<int>(std::lround(half * fps)), stride = std::max(1, static_cast<int>(std::lround(step * fps)));
  const auto begin = std::lower_bound(sights.begin(), sights.end(), frame - reach, [](const Sight& s, int f) { return s.frame < f; });
  for (auto sight = begin; sight != sights.end() && sight->frame <= frame + reach; ++sight) {
    if ((sight->frame - frame) % stride != 0) continue;
    glance.sights.push_back(&*sight);
    glance.offsets.push_back((sight->frame - frame) / fps);
  }
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

void refine(Match& match, const Glance& glance, const Scenelet& scenelet, const Vec3& camera) {
  constexpr double kSigma = 0.12;  // m: beyond it a joint counts less and less
  constexpr int kRounds = 4;
  for (int round = 0; round <= kRounds; ++round) {
    PlacementCost cost;
    double weights = 0, errors = 0;
    for (std::size_t i = 0; i < glance.sights.size(); ++i) {
      const auto pose = pose_at(scenelet, glance.offsets[i]);
      if (!pose) continue;
      const Sight& sight = *glance.sights[i];
      const Pose placed = match.placement * *pose;
      for (int k = 0; k < kJoints; ++k) {
        const double confidence = sight.confidence[k];
        if (confidence < kSeen) continue;
        const Vec3 from = placed.col(k) - camera;
        const double off = from.dot(sight.information[k] * from) / confidence / (kSigma * kSigma);
        cost.add(pose->col(k), camera, sight.information[k] / (1.0 + off));
        weights += confidence;
        errors += confidence * kSigma * kSigma * std::log1p(off);
      }
    }
    if (!(weights > 0)) return;
    match.error = errors / weights;
    PlacementFit fit;
    if (round == kRounds || !fit_placement(cost, fit)) return;
    match.placement = {{fit.position.x(), fit.position.y(), 0}, fit.angle};
  }
}

}  // namespace unseen::interactions
