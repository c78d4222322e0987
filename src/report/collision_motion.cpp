// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_motion.h"

#include <algorithm>

#include "unseen/collision/body_mesh.h"

namespace unseen::report {
namespace {

using namespace collision;

constexpr double kSameTime = 2e-5;  // s: what float32 tells apart

/// The key before `time` (the last but one at the end), and how far it is to the next.
std::pair<std::size_t, double> step_at(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return {0, 0.0};
  const auto i = static_cast<std::size_t>(after - times.begin()) - 1;
  if (i + 1 == times.size()) return {i, 0.0};
  return {i, (time - times[i]) / (times[i + 1] - times[i])};
}

/// Where a body is at an impact: as solved at the first one, at others by its flight from the nearest frame.
BodyState state_at(const Reconstruction& r, int body, std::size_t impact, const Motion& frames, double gravity) {
  if (impact == 0) return r.bodies[static_cast<std::size_t>(body)].before;
  const double time = r.impacts[impact].time;
  const FramePose* before = nullptr;
  for (const FramePose& f : r.frames)
    if (f.bodies[static_cast<std::size_t>(body)] && f.time <= time) before = &f;
  BodyState s;
  s.q = frames.rotation(time);
  s.p = frames.position(time);
  if (before == nullptr) return s;
  const BodyState& from = *before->bodies[static_cast<std::size_t>(body)];
  const double dt = time - before->time;
  if (from.v != Vec3::Zero()) s.p = from.p + dt * from.v + 0.5 * dt * dt * gravity * r.gravity_direction;
  return s;
}

void insert(Motion& motion, double time, const BodyState& state) {
  const auto at = std::lower_bound(motion.times.begin(), motion.times.end(), time - kSameTime);
  const auto i = at - motion.times.begin();
  if (at != motion.times.end() && *at < time + kSameTime) return;
  motion.times.insert(at, time);
  motion.positions.insert(motion.positions.begin() + i, state.p);
  motion.rotations.insert(motion.rotations.begin() + i, state.q);
}

}  // namespace

Vec3 Motion::position(double time) const {
  const auto [i, f] = step_at(times, time);
  return f > 0 ? Vec3((1.0 - f) * positions[i] + f * positions[i + 1]) : positions[i];
}

Quat Motion::rotation(double time) const {
  const auto [i, f] = step_at(times, time);
  return f > 0 ? rotations[i].slerp(f, rotations[i + 1]) : rotations[i];
}

Motion motion_of(const Reconstruction& r, int body, double gravity) {
  Motion motion;
  for (const FramePose& f : r.frames)
    if (const auto& state = f.bodies[static_cast<std::size_t>(body)]) insert(motion, f.time, *state);
  if (motion.times.empty()) return motion;
  const Motion frames = motion;
  for (std::size_t i = 0; i < r.impacts.size(); ++i) {
    const Impact& impact = r.impacts[i];
    if (impact.between[0] == body || impact.between[1] == body) insert(motion, impact.time, state_at(r, body, i, frames, gravity));
  }
  keep_signs(motion);
  return motion;
}

void keep_signs(Motion& motion) {
  for (std::size_t i = 1; i < motion.rotations.size(); ++i)
    if (motion.rotations[i].dot(motion.rotations[i - 1]) < 0.0) motion.rotations[i].coeffs() *= -1.0;
}

std::vector<Vec3> fixed_quad(const Shot& shot, const Reconstruction& r) {
  Plane plane;
  if (!r.fixed.empty() && !r.impacts.empty()) {
    plane.normal = r.impacts.front().normal;
    plane.offset = plane.normal.dot(r.impacts.front().contact_point);
  } else if (shot.floor) {
    plane.normal = r.T_world_camera.rotation * shot.floor->normal;
    plane.offset = shot.floor->offset + plane.normal.dot(r.T_world_camera.translation);
  } else {
    return {};
  }
  std::vector<Vec3> points;
  for (const FramePose& f : r.frames)
    for (const auto& body : f.bodies)
      if (body) points.push_back(body->p);
  for (const Impact& impact : r.impacts) points.push_back(impact.contact_point);
  double margin = 0;
  for (const Body& body : shot.bodies) margin = std::max(margin, 2.0 * largest_extent(body));
  return quad_below(plane, points, margin);
}

std::vector<Vec3> quad_below(const Plane& plane, const std::vector<Vec3>& points, double margin) {
  const Vec3 u = any_orthogonal(plane.normal), v = plane.normal.cross(u);
  Eigen::AlignedBox2d reach;
  for (const Vec3& p : points) reach.extend(Vec2(u.dot(p), v.dot(p)));
  if (reach.isEmpty()) return {};
  margin = std::max(margin, 0.1 * reach.sizes().norm());
  const Vec2 low = reach.min() - Vec2::Constant(margin), high = reach.max() + Vec2::Constant(margin);
  const auto corner = [&](double a, double b) { return Vec3(a * u + b * v + plane.offset * plane.normal); };
  return {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()), corner(low.x(), high.y())};
}

std::string name_of(const Reconstruction& r, int body) {
  const auto b = static_cast<std::size_t>(body);
  return b < r.bodies.size() && !r.bodies[b].name.empty() ? r.bodies[b].name : "body " + std::to_string(body);
}

}  // namespace unseen::report
