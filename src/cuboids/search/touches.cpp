// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "cuboids/search/problem.h"

namespace unseen::cuboids {
namespace {

constexpr double kFilled = 0.25;   // of a gap: so deep its middle lies in what fills it

/// How far two bodies overlap, m; 0 if they don't.
double overlap(const Problem& problem, const std::vector<ConvexSolid>& solids, int a, int b) {
  const ConvexSolid& second = solids[b - problem.supports_count()];
  const auto meet = problem.is_support(a) ? interface_of(problem.supports[a], second, 0.0)
                                          : interface_of(solids[a - problem.supports_count()], second, 0.0);
  return meet ? std::max(0.0, -meet->gap) : 0.0;
}

/// Whether a third body fills the gap of a touch, so that the two don't meet.
bool is_filled(const std::vector<ConvexSolid>& solids, int first, const Touch& touch) {
  const double gap = touch.interface.gap;
  if (gap <= 0.0) return false;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : touch.interface.points) middle += p / static_cast<double>(touch.interface.points.size());
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const int body = first + static_cast<int>(i);
    if (body == touch.a || body == touch.b || (middle - solids[i].center).norm() > solids[i].radius) continue;
    const auto is_inside = [&](const Plane& face) { return face.signed_distance(middle) < -kFilled * gap; };
    if (std::all_of(solids[i].planes.begin(), solids[i].planes.end(), is_inside)) return true;
  }
  return false;
}

bool may_meet(const Problem& problem, const Arrangement& arrangement, int a, int b, double tolerance) {
  const OrientedBox& second = arrangement.boxes[b - problem.supports_count()];
  if (problem.is_support(a))
    return problem.supports[a].plane.signed_distance(second.center) < second.half_size.norm() + tolerance;
  const OrientedBox& first = arrangement.boxes[a - problem.supports_count()];
  const double reach = first.half_size.norm() + second.half_size.norm() + tolerance;
  return (first.center - second.center).squaredNorm() < reach * reach;
}

}  // namespace

std::optional<Touch> touch_of(const Problem& problem, const Arrangement& arrangement, int a, int b) {
  const double tolerance = problem.pair_tolerance(a, b);
  if (problem.is_one_object(a, b) || !may_meet(problem, arrangement, a, b, tolerance)) return std::nullopt;
  const int first_cuboid = problem.supports_count();
  const ConvexSolid& second = arrangement.solids[b - first_cuboid];
  auto meet = problem.is_support(a) ? interface_of(problem.supports[a], second, tolerance)
                                    : interface_of(arrangement.solids[a - first_cuboid], second, tolerance);
  if (!meet) return std::nullopt;
  Touch touch{a, b, std::move(*meet)};
  return is_filled(arrangement.solids, first_cuboid, touch) ? std::nullopt : std::optional(std::move(touch));
}

std::vector<Touch> touching_pairs(const Problem& problem, const Arrangement& arrangement) {
  std::vector<Touch> touches;
  for (int a = 0; a < problem.bodies(); ++a)
    for (int b = std::max(a + 1, problem.supports_count()); b < problem.bodies(); ++b)
      if (auto touch = touch_of(problem, arrangement, a, b)) touches.push_back(std::move(*touch));
  return touches;
}

std::vector<Touch> with_moved(const Problem& problem, const Arrangement& arrangement, std::vector<Touch> touches, int body) {
  std::erase_if(touches, [&](const Touch& t) { return t.a == body || t.b == body; });
  for (int other = 0; other < problem.bodies(); ++other)
    if (other != body)
      if (auto touch = touch_of(problem, arrangement, std::min(body, other), std::max(body, other))) touches.push_back(std::move(*touch));
  std::sort(touches.begin(), touches.end(), [](const Touch& s, const Touch& t) { return std::pair(s.a, s.b) < std::pair(t.a, t.b); });
  return touches;
}

bool penetrates(const Problem& problem, const Arrangement& arrangement) {
  const int first_cuboid = problem.supports_count();
  std::vector<ConvexSolid> initial(problem.cuboids.size());
  for (int b = first_cuboid; b < problem.bodies(); ++b) {
    const std::size_t i = b - first_cuboid;
    for (int a = 0; a < b; ++a) {
      const bool grown = arrangement.boxes[i].volume() > problem.cuboids[i].initial.volume() ||
                         (!problem.is_support(a) && arrangement.boxes[a - first_cuboid].volume() > problem.cuboid(a).initial.volume());
      if (!grown || problem.is_one_object(a, b) || !may_meet(problem, arrangement, a, b, 0.0)) continue;
      const double now = overlap(problem, arrangement.solids, a, b);
      if (now <= problem.pair_tolerance(a, b)) continue;
      if (!problem.is_support(a)) initial[a - first_cuboid] = solid_of(problem.cuboid(a).initial);
      initial[i] = solid_of(problem.cuboids[i].initial);
      if (now > overlap(problem, initial, a, b) + 1e-9) return true;
    }
  }
  return false;
}

}  // namespace unseen::cuboids
