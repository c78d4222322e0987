// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "collision/evaluate/penetration.h"
#include "collision/orientations/symmetry.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

void check_names(const Reconstruction& result, const Truth& truth) {
  for (std::size_t b = 0; b < result.bodies.size(); ++b) {
    const std::string expected = b < truth.bodies.size() ? truth.bodies[b].name : "none";
    if (result.bodies[b].name != expected)
      throw InputError("result", fmt::format("bodies[{}].name", b), '"' + result.bodies[b].name + '"', '"' + expected + "\", as in the truth");
  }
}

std::optional<ValueScore> score(const std::optional<Estimate>& value, const std::optional<double>& truth, bool relative) {
  if (!value || !truth) return std::nullopt;
  const double error = std::abs(value->value - *truth);
  return ValueScore{value->value, *truth, relative ? error / *truth : error, value->low <= *truth && *truth <= value->high};
}

/// The turns that nobody can see of a body; none for a ball, which may turn as it likes.
std::vector<Quat> own_turns(const Body& body) {
  if (body.shape == Shape::box || body.shape == Shape::mesh) return symmetry_of(body_mesh(body, body.name).vertices).turns;
  return {};
}

/// A body's pose in camera coordinates.
RigidTransform in_camera(const BodyState& s, const RigidTransform& T_world_camera) {
  return T_world_camera.inverse() * RigidTransform{s.q.normalized().toRotationMatrix(), s.p};
}

MotionScore score_motion(const Reconstruction& result, const Truth& truth, std::size_t b) {
  std::map<int, const BodyState*> solved;
  for (const FramePose& f : result.frames)
    if (f.bodies[b]) solved[f.frame] = &*f.bodies[b];
  const std::vector<Quat> turns = own_turns(truth.bodies[b]);
  MotionScore s;
  s.name = truth.bodies[b].name;
  Vec3 squares = Vec3::Zero();
  double angles = 0;
  for (const FramePose& f : truth.frames) {
    const auto at = solved.find(f.frame);
    if (!f.bodies[b] || at == solved.end()) continue;
    const RigidTransform found = in_camera(*at->second, result.T_world_camera), real = in_camera(*f.bodies[b], truth.T_world_camera);
    squares += (found.translation - real.translation).cwiseAbs2();
    const double angle = angle_between(Quat(found.rotation), Quat(real.rotation), turns);
    angles += angle * angle;
    ++s.frames;
  }
  if (s.frames == 0) return s;
  const double size = largest_extent(truth.bodies[b]);
  s.trajectory = std::sqrt(squares.sum() / s.frames) / size;
  s.depth = std::sqrt(squares.z() / s.frames) / size;
  s.across = std::sqrt((squares.x() + squares.y()) / s.frames) / size;
  if (!turns.empty()) s.rotation = std::sqrt(angles / s.frames);
  return s;
}

/// Each true impact takes the nearest of the result's that is left, within half the time to its neighbours.
void score_times(const Reconstruction& result, const Truth& truth, Evaluation& e) {
  double window = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < truth.impacts.size(); ++i) window = std::min(window, 0.5 * (truth.impacts[i].time - truth.impacts[i - 1].time));
  std::vector<bool> used(result.impacts.size(), false);
  double sum = 0;
  for (const Impact& real : truth.impacts) {
    std::size_t best = used.size();
    double least = window;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double off = std::abs(result.impacts[i].time - real.time);
      if (!used[i] && off <= least) best = i, least = off;
    }
    if (best == used.size()) continue;
    used[best] = true;
    sum += least * truth.fps;
    ++e.found;
  }
  if (e.found > 0) e.time = sum / e.found;
}

std::optional<double> penetration_at_impact(const Reconstruction& result, const Truth& truth) {
  if (result.impacts.empty() || truth.impacts.empty() || result.bodies.size() != 2) return std::nullopt;
  const auto pose = [&](std::size_t b) { return in_camera(result.bodies[b].before, result.T_world_camera); };
  if (!result.bodies[1].fixed) return std::max(0.0, penetration(truth.bodies[0], pose(0), truth.bodies[1], pose(1)));
  const RigidTransform T_camera_world = truth.T_world_camera.inverse();
  Plane plane;
  plane.normal = T_camera_world.rotation * truth.impacts.front().normal;
  plane.offset = plane.normal.dot(T_camera_world * truth.impacts.front().contact_point);
  return std::max(0.0, penetration(truth.bodies[0], pose(0), plane));
}

}  // namespace

Evaluation evaluate(const Reconstruction& result, const Truth& truth) {
  check_names(result, truth);
  Evaluation e;
  e.impacts = static_cast<int>(result.impacts.size());
  e.true_impacts = static_cast<int>(truth.impacts.size());
  e.restitution = score(result.restitution, truth.restitution, false);
  e.mass_ratio = score(result.mass_ratio, truth.mass_ratio, true);
  for (std::size_t b = 0; b < truth.bodies.size() && b < 2; ++b)
    if (truth.bodies[b].shape != Shape::fixed) e.motions.push_back(score_motion(result, truth, b));
  score_times(result, truth, e);
  e.penetration = penetration_at_impact(result, truth);
  const Vec3 up = result.T_world_camera.rotation.row(2), true_up = truth.T_world_camera.rotation.row(2);
  e.gravity = std::atan2(up.cross(true_up).norm(), up.dot(true_up));
  return e;
}

}  // namespace unseen::collision
