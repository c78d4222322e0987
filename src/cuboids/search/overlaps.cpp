// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <limits>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kSeenShrink = 0.15, kHiddenShrink = 0.5;  // of a size: what a face may give way, seen or not
constexpr double kTowards = 0.5;                           // cosine: a face looks at the other body
const double kFlush = std::cos(radians(10.0));             // between a face and the support that it lies on
constexpr double kTouching = 1e-6;                         // m
constexpr double kSlightly = 1e-3;                         // m: what an engine pushes apart unseen
constexpr int kPasses = 4;                                 // one face that gives way may help several pairs

/// A face that gives way to another body.
struct Retreat {
  int cuboid = -1, face = -1;
  double length = 0, share = std::numeric_limits<double>::infinity();  ///< m; of what it may give way
};

std::optional<Interface> meet(const Problem& problem, const std::vector<OrientedBox>& boxes, int a, int b) {
  const ConvexSolid second = solid_of(boxes[b - problem.supports_count()]);
  return problem.is_support(a) ? interface_of(problem.supports[a], second, 0.0)
                               : interface_of(solid_of(boxes[a - problem.supports_count()]), second, 0.0);
}

double depth_of(const Problem& problem, const std::vector<OrientedBox>& boxes, int a, int b) {
  const auto there = meet(problem, boxes, a, b);
  return there ? std::max(0.0, -there->gap) : 0.0;
}

/// Whether a body stands on (leans at) a support with a face: to give way there would lift it off.
bool bears_on_support(const Problem& problem, const std::vector<OrientedBox>& boxes, int body, int face) {
  const Vec3 normal = face_normal(boxes[body - problem.supports_count()], face);
  for (int support = 0; support < problem.supports_count(); ++support) {
    const double tolerance = problem.pair_tolerance(support, body);
    const auto there = interface_of(problem.supports[support], solid_of(boxes[body - problem.supports_count()]), tolerance);
    if (there && std::abs(there->gap) <= tolerance && std::abs(there->normal.dot(normal)) > kFlush) return true;
  }
  return false;
}

/// The least move of one face of `body` that ends its overlap, `towards` being where the other body lies.
void propose_retreats(const DepthView& view, const Problem& problem, std::vector<OrientedBox> boxes, int a, int b, int body,
                      const Vec3& towards, double depth, Retreat& best) {
  OrientedBox& box = boxes[body - problem.supports_count()];
  const OrientedBox before = box;
  const int other = a == body ? b : a;
  for (int face = 0; face < 6; ++face) {
    const Vec3 normal = face_normal(before, face);
    const double cosine = normal.dot(towards), size = 2.0 * before.half_size[face / 2];
    if (cosine < kTowards) continue;
    const bool seen = normal.dot(view.viewpoint() - before.center) > before.half_size[face / 2];
    const double length = depth / cosine, share = length / (size * (seen ? kSeenShrink : kHiddenShrink));
    if (share > 1.0 || share >= best.share) continue;
    if (!problem.is_support(other) && bears_on_support(problem, boxes, body, face)) continue;
    box = extended(before, face, -length);
    if (depth_of(problem, boxes, a, b) <= kTouching) best = {body - problem.supports_count(), face, length, share};
    box = before;
  }
}

/// The face of two overlapping bodies that gives way best; none if that is too much for all.
Retreat retreat_of(const DepthView& view, const Problem& problem, const std::vector<OrientedBox>& boxes, int a, int b, const Interface& there) {
  Retreat best;
  propose_retreats(view, problem, boxes, a, b, b, -there.normal, -there.gap, best);
  if (!problem.is_support(a)) propose_retreats(view, problem, boxes, a, b, a, there.normal, -there.gap, best);
  return best;
}

}  // namespace

void part_overlaps(const DepthView& view, Problem& problem) {
  std::vector<OrientedBox> boxes = arrange(problem, {}).boxes;
  for (int round = 0; round < kPasses; ++round) {
    bool changed = false;
    for (int b = problem.supports_count(); b < problem.bodies(); ++b)
      for (int a = 0; a < b; ++a) {
        if (problem.is_one_object(a, b)) continue;
        const auto there = meet(problem, boxes, a, b);
        if (!there || there->gap > -kTouching) continue;
        const Retreat retreat = retreat_of(view, problem, boxes, a, b, *there);
        if (retreat.cuboid < 0) continue;
        boxes[retreat.cuboid] = extended(boxes[retreat.cuboid], retreat.face, -retreat.length);
        changed = true;
      }
    if (!changed) break;
  }
  for (int b = problem.supports_count(); b < problem.bodies(); ++b) {
    problem.cuboids[b - problem.supports_count()].initial = boxes[b - problem.supports_count()];
    for (int a = problem.supports_count(); a < b; ++a)
      if (!problem.is_one_object(a, b) && !problem.are_known_objects(a, b) && depth_of(problem, boxes, a, b) > problem.pair_tolerance(a, b))
        problem.joints.push_back({a, b});
  }
}

void end_overlaps(const DepthView& view, const Problem& problem, const std::vector<char>& held, Arrangement& arrangement) {
  const std::vector<int> group = structure_of(problem, arrangement, {}, std::vector<char>(problem.bodies(), 0)).group;
  const Problem written = as_written(problem);
  for (int b = problem.supports_count(); b < problem.bodies(); ++b)
    for (int a = 0; a < b; ++a) {
      if (group[a] == group[b]) continue;
      const Problem& shown = held[b] ? problem : written;  // what is held may be below a ground that ends
      const auto there = meet(shown, arrangement.boxes, a, b);
      if (!there || there->gap > -kSlightly) continue;
      const Retreat retreat = retreat_of(view, shown, arrangement.boxes, a, b, *there);
      if (retreat.cuboid >= 0) {
        Arrangement parted = with_face(problem, arrangement, retreat.cuboid, retreat.face, -retreat.length);
        if (depth_of(shown, parted.boxes, a, b) < kSlightly && stands(problem, parted, held)) {
          arrangement = std::move(parted);
          continue;
        }
      }
      arrangement.fix({a, b});
    }
}

}  // namespace unseen::cuboids
