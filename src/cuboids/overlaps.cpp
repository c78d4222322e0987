// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <limits>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kSeenShrink = 0.15, kHiddenShrink = 0.5;  // of a size: what a face may give way, seen or not
constexpr double kTowards = 0.5;                           // cosine: a face looks at the other body
constexpr double kTouching = 1e-6;                         // m
constexpr double kSlightly = 1e-3;                         // m: what an engine pushes apart unseen
constexpr int kRounds = 4;                                 // one face that gives way may help several pairs

/// A face that gives way to another body.
struct Retreat {
  int cuboid = -1, face = -1;
  double length = 0, share = std::numeric_limits<double>::infinity();  ///< m; of what it may give way
};

std::optional<Interface> meet(const Problem& problem, int a, int b) {
  const ConvexSolid second = solid_of(problem.cuboid(b).initial);
  return problem.is_support(a) ? interface_of(problem.supports[a], second, 0.0) : interface_of(solid_of(problem.cuboid(a).initial), second, 0.0);
}

double depth_of(const Problem& problem, int a, int b) {
  const auto there = meet(problem, a, b);
  return there ? std::max(0.0, -there->gap) : 0.0;
}

/// The least move of one face of `body` that ends its overlap, `towards` being where the other body lies.
void propose_retreats(const DepthView& view, Problem problem, int a, int b, int body, const Vec3& towards, double depth, Retreat& best) {
  OrientedBox& box = problem.cuboids[body - problem.supports_count()].initial;
  const OrientedBox before = box;
  for (int face = 0; face < 6; ++face) {
    const Vec3 normal = face_normal(before, face);
    const double cosine = normal.dot(towards), size = 2.0 * before.half_size[face / 2];
    if (cosine < kTowards) continue;
    const bool seen = normal.dot(view.viewpoint() - before.center) > before.half_size[face / 2];
    const double length = depth / cosine, share = length / (size * (seen ? kSeenShrink : kHiddenShrink));
    if (share > 1.0 || share >= best.share) continue;
    box = extended(before, face, -length);
    if (depth_of(problem, a, b) <= kTouching) best = {body - problem.supports_count(), face, length, share};
    box = before;
  }
}

Retreat retreat_of(const DepthView& view, const Problem& problem, int a, int b, const Interface& there) {
  Retreat best;
  propose_retreats(view, problem, a, b, b, -there.normal, -there.gap, best);
  if (!problem.is_support(a)) propose_retreats(view, problem, a, b, a, there.normal, -there.gap, best);
  return best;
}

}  // namespace

void part_overlaps(const DepthView& view, Problem& problem) {
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (int b = problem.supports_count(); b < problem.bodies(); ++b)
      for (int a = 0; a < b; ++a) {
        if (problem.is_one_object(a, b)) continue;
        const auto there = meet(problem, a, b);
        if (!there || there->gap > -kTouching) continue;
        const Retreat retreat = retreat_of(view, problem, a, b, *there);
        if (retreat.cuboid < 0) continue;
        OrientedBox& box = problem.cuboids[retreat.cuboid].initial;
        box = extended(box, retreat.face, -retreat.length);
        changed = true;
      }
    if (!changed) break;
  }
  for (int b = problem.supports_count(); b < problem.bodies(); ++b)
    for (int a = problem.supports_count(); a < b; ++a)
      if (!problem.is_one_object(a, b) && depth_of(problem, a, b) > problem.pair_tolerance(a, b)) problem.joints.push_back({a, b});
}

void join_overlaps(const Problem& problem, Arrangement& arrangement) {
  const std::vector<int> group = structure_of(problem, arrangement, {}, std::vector<char>(problem.bodies(), 0)).group;
  for (int b = problem.supports_count(); b < problem.bodies(); ++b)
    for (int a = 0; a < b; ++a) {
      if (group[a] == group[b]) continue;
      const ConvexSolid& second = arrangement.solids[b - problem.supports_count()];
      const auto there = problem.is_support(a) ? interface_of(problem.supports[a], second, 0.0)
                                               : interface_of(arrangement.solids[a - problem.supports_count()], second, 0.0);
      if (there && -there->gap > kSlightly) arrangement.fixed.push_back({a, b});
    }
  std::sort(arrangement.fixed.begin(), arrangement.fixed.end());
}

}  // namespace unseen::cuboids
