// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/restitution.h"
#include "collision/frames.h"
#include "collision/orientations/symmetry.h"
#include "collision/solve/residuals.h"
#include "collision/solve/spin_starts.h"
#include "collision/solve/unknowns.h"
#include "unseen/core/level.h"

namespace unseen::collision {
namespace {

constexpr double kSureEnough = 0.12;  // deviation of the restitution above which no value is called confident

/// Whether c ≤ 1 agrees with the data: what the soft bound gives way tells how far beyond it they would lead, in deviations. Nothing real
/// ends at 0, but solutions that went astray do.
bool within_bounds(const SolvedImpact& impact) {
  constexpr double kFar = 2.0;
  const State& state = impact.solution.fit.state;
  const double c = restitution<double>(impact.solution.problem, state, values_of(impact.solution.problem, state));
  return c > 0.0 && std::max(0.0, c - 1.0) * impact.uncertain.restitution.sd < kFar * kBound * kBound;
}

/// One impact's solution in world coordinates.
struct Teller {
  const SolvedImpact& impact;
  const Mat3& to_world;

  const Problem& problem() const { return impact.solution.problem; }
  const State& state() const { return impact.solution.fit.state; }

  Impact describe(const FrameClock& clock) const {
    const StateT<double> s = values_of(problem(), state());
    Impact told;
    told.time = s.time;
    told.frame = clock.frame_at(s.time);
    told.restitution = impact.uncertain.restitution;
    told.impulse = to_world * s.impulse;
    told.contact_point = to_world * (problem().fixed && !impact.solution.fit.touch ? Vec3(s.p[0] - contact_normal<double>(state(), s) * 0.5 * problem().solids[0].mass.extent) : s.x);
    const Vec3 n = contact_normal<double>(state(), s);
    told.normal = to_world * n;
    if (state().law) {
      const Vec3 across = s.impulse - n * n.dot(s.impulse);
      told.friction = across.norm() / std::max(1e-9, n.dot(s.impulse));
      const auto sliding = [&](bool after) {
        const Vec3 u = contact_velocity<double>(problem(), s, 0, after) - contact_velocity<double>(problem(), s, 1, after);
        return Vec3(u - n * n.dot(u));
      };
      const Vec3 before = sliding(false);
      const bool turning_known = problem().turns(0) && (problem().fixed || problem().turns(1));
      if (turning_known && before.norm() > 0.05) told.tangential_restitution = -sliding(true).dot(before) / before.squaredNorm();
    }
    return told;
  }
};

/// Whether the impulse on a body points down so much that what the body lies on pushes back.
bool pressed_down(const State& state, int body) {
  constexpr double kPressed = 0.1;  // of the impulse
  return (body == 0 ? 1.0 : -1.0) * state.impulse.dot(state.down) > kPressed * state.impulse.norm();
}

/// What the data hardly tell, in words.
std::vector<std::string> observability(const SolvedImpact& impact, const Shot& shot) {
  std::vector<std::string> remarks;
  const Problem& problem = impact.solution.problem;
  const Fit& fit = impact.solution.fit;
  const auto sd = [&](int unknown) { return fit.covariance.size() ? std::sqrt(std::max(0.0, fit.covariance(unknown, unknown))) : 0.0; };
  for (int o = 0; o < (problem.fixed ? 1 : 2); ++o) {
    const std::string& name = shot.bodies[o].name;
    if (!problem.flies(o, false)) remarks.push_back(fmt::format("{}: it lies still until it is hit; what it lies on is taken to push no more then{}", name, pressed_down(fit.state, o) ? ", though the impulse presses it down" : ""));
    const double depth = fit.state.p[o].z(), deviation = sd(kP + 3 * o + 2);
    if (deviation > 0.05 * depth) remarks.push_back(fmt::format("{}: its distance from the camera is known to {:.0f} % only: too little curvature by gravity", name, 100.0 * deviation / depth));
    const double along = sd(kV + 3 * o + 2), across = std::max(sd(kV + 3 * o), sd(kV + 3 * o + 1));
    if (along > 0.2 && along > 5.0 * across) remarks.push_back(fmt::format("{}: its speed along the view ray is known to ±{:.1f} m/s only", name, along));
    if (!problem.solids[o].is_sphere() && !problem.turns(o)) remarks.push_back(fmt::format("{}: how it turns is not known; the impact is taken as one of its centre", name));
    for (const bool after : {false, true})
      if (const OpenTurns turns = open_turns(problem, o, after); turns.open && turns.orientations == 2)
        remarks.push_back(fmt::format("{}: how often it turned between its two orientations {} the impact is told by the impact alone; a third orientation would settle it", name, after ? "after" : "before"));
    const bool found = std::none_of(shot.orientations.begin(), shot.orientations.end(), [&](const auto& given) { return given.body == o; });
    if (!found || !problem.turns(o)) continue;
    if (const auto share = nearly_alike_sides(shot.bodies[o]))
      remarks.push_back(fmt::format("{}: two of its sides differ by {:.0f} % only; it may be turned by 90° about the third", name, 100.0 * *share));
    if (const auto turn = nearly_alike_turn(problem.solids[o].hull.vertices); turn && shot.bodies[o].shape == Shape::mesh)
      remarks.push_back(fmt::format("{}: it looks nearly the same turned by {:.0f}°; it may be turned so", name, degrees(*turn)));
  }
  if (problem.level) remarks.push_back(fmt::format("{}: taken to be level; give its \"normal\" if it is not", shot.bodies[1].name));
  if (problem.plumb) remarks.push_back(fmt::format("{}: taken to be about plumb; give \"down\" if it is not", shot.bodies[1].name));
  if (!fit.state.law) remarks.push_back("the contact's normal is taken to be the impulse's direction: friction is not told from restitution");
  return remarks;
}

void add_residuals(const SolvedImpact& impact, Reconstruction& result) {
  const Problem& problem = impact.solution.problem;
  const StateT<double> s = values_of(problem, impact.solution.fit.state);
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const PointObservation& seen = problem.points[i];
    result.residuals.push_back({seen.frame, seen.body, seen.pixel, problem.camera.project(position_at<double>(problem, s, seen.body, seen.after, seen.time)),
                                !impact.check.held_out[i] && !impact.check.outlier[i]});
  }
}

}  // namespace

RigidTransform world_of(const Vec3& down, bool planar) {
  const Vec3 up = planar ? Vec3(-Vec3::UnitY()) : Vec3(-down.normalized());
  return {level_rotation(up), Vec3::Zero()};
}

void describe(const Shot& shot, const Tracks& tracks, double fps, const std::vector<SolvedImpact>& impacts, Reconstruction& result) {
  const SolvedImpact& first = impacts.front();
  const Problem& problem = first.solution.problem;
  const State& state = first.solution.fit.state;
  result.T_world_camera = world_of(state.down, problem.planar);
  result.gravity_direction = result.T_world_camera.rotation * state.down;
  result.camera = problem.camera;
  result.fps = fps;
  result.fixed = problem.fixed ? shot.bodies[1].name : "";
  const FrameClock clock(tracks, fps);
  const Mat3& to_world = result.T_world_camera.rotation;
  std::vector<Teller> tellers;
  for (const SolvedImpact& impact : impacts) tellers.push_back({impact, to_world});

  std::vector<Estimate> restitutions;
  std::vector<Vec3> common;
  double used = 0.0, held_out = 0.0;
  for (const Teller& teller : tellers) {
    result.impacts.push_back(teller.describe(clock));
    if (teller.impact.check.fits && within_bounds(teller.impact)) {
      restitutions.push_back(teller.impact.uncertain.restitution);
      common.push_back(teller.impact.uncertain.common);
    }
    add_residuals(teller.impact, result);
  }
  const auto fitting = std::count_if(impacts.begin(), impacts.end(), [](const SolvedImpact& i) { return i.check.fits; });
  result.fits = !restitutions.empty() && 2 * fitting >= static_cast<std::ptrdiff_t>(impacts.size());
  for (const SolvedImpact& impact : impacts)
    if (impact.check.fits || !result.fits) {
      const double share = 1.0 / static_cast<double>(result.fits ? fitting : static_cast<std::ptrdiff_t>(impacts.size()));
      used += share * std::pow(impact.check.used_rms, 2);
      held_out += share * std::pow(impact.check.held_out_rms, 2);
    }
  result.reprojection_rms = std::sqrt(used);
  result.held_out_rms = std::sqrt(held_out);
  if (result.fits) {
    const Estimate c = pooled(restitutions, common);
    const bool one_collision = problem.fixed || tracks.collisions_seen <= 1;
    if (c.sd < kSureEnough && one_collision) result.restitution = c;
    if (!problem.fixed && one_collision) result.mass_ratio = first.uncertain.mass_ratio;
  }
  result.ambiguous = first.solution.others;
  for (int o = 0; o < 2; ++o) {
    BodyResult body;
    body.name = shot.bodies[o].name;
    body.fixed = o == 1 && problem.fixed;
    body.inertia = problem.solids[o].mass.inertia;
    if (!body.fixed) body.before = body_at(first, to_world, o, false, state.time), body.after = body_at(first, to_world, o, true, state.time);
    result.bodies.push_back(body);
  }
  const StateT<double> s = values_of(problem, state);
  result.energy_before = kinetic_energy<double>(problem, s, false);
  result.energy_after = kinetic_energy<double>(problem, s, true);
  for (const auto& [name, size] : first.solution.fit.terms) result.terms.push_back({name, size, 1.0});
  result.observability = observability(first, shot);
  if (problem.drag[0] > 0.0) result.drag = problem.drag[0];
  if (result.fits && problem.planar && problem.drag[0] == 0.0) result.slowing = problem.slowing;
  result.frames = frame_poses(impacts, to_world, tracks, clock);
}

}  // namespace unseen::collision
