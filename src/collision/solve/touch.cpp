// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/touch.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

/// Where on an edge or face that meets a plane the impulse may have acted: as near as can be to the line of the impulse, which turned the body as was seen.
Vec3 start_on(const Feature& feature, const State& state) {
  const Vec3 n = feature.axes.col(0), to = feature.point - state.x;
  const double along = n.dot(state.impulse);
  if (std::abs(along) < 1e-9) return feature.point;
  const Vec3 off = state.impulse * (n.dot(to) / along) - to;
  Vec3 start = feature.point;
  for (int i = 1; i < 3; ++i) start += feature.axes.col(i) * std::clamp(feature.axes.col(i).dot(off), -feature.extent[i], feature.extent[i]);
  return start;
}

}  // namespace

std::optional<Proximity> touch_of(const Problem& problem, const State& state) {
  const Solid& a = problem.solids[0];
  const double tolerance = 0.03 * a.mass.extent;
  if (!problem.has_pose(0)) return std::nullopt;
  if (problem.fixed) {
    const std::optional<Vec3> normal = problem.normal_of_fixed(state.down);
    if (!normal) return std::nullopt;
    const bool along_impulse = a.is_sphere() && !problem.friction && state.impulse.norm() > 0.0;
    Proximity near = nearest_to_plane(a, state.p[0], state.q[0], along_impulse ? Vec3(state.impulse.normalized()) : *normal, tolerance);
    if (problem.level && !along_impulse) near.law.kind = ContactLaw::Kind::level;
    return near;
  }
  if (!problem.has_pose(1)) return std::nullopt;
  return nearest(a, state.p[0], state.q[0], problem.solids[1], state.p[1], state.q[1], tolerance);
}

Vec3 contact_start(const Problem& problem, const Proximity& touch, const State& state) {
  if (problem.fixed && !problem.solids[0].is_sphere()) return start_on(touch.features[0], state);
  return 0.5 * (touch.point_a + touch.point_b);
}

std::optional<ContactLaw> law_of(const Problem& problem, const State& state, const std::optional<Proximity>& touch) {
  if (!problem.friction) return std::nullopt;
  if (touch) return touch->law;
  const std::optional<Vec3> normal = problem.fixed ? problem.normal_of_fixed(state.down) : std::nullopt;
  if (!normal) return std::nullopt;
  ContactLaw law;
  law.kind = problem.level ? ContactLaw::Kind::level : ContactLaw::Kind::constant;
  law.a = *normal;
  return law;
}

}  // namespace unseen::collision
