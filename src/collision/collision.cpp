// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/collision.h"

#include <fmt/format.h>

#include <cmath>

#include "collision/describe.h"
#include "collision/doubts/common_error.h"
#include "collision/evidence.h"
#include "collision/hints.h"
#include "collision/positions.h"
#include "collision/remarks.h"
#include "collision/sighted.h"
#include "collision/solve/drag.h"
#include "collision/solve/terms.h"
#include "collision/solve_turning.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

void reconstruct_into(const Shot& shot, const Options& options, Context& context, Reconstruction& result) {
  Summary& summary = result.summary;
  if (shot.bodies.size() != 2) throw InputError(shot.name, "bodies", std::to_string(shot.bodies.size()), "two");
  if (shot.fps && !(*shot.fps > 0.0 && std::isfinite(*shot.fps))) throw InputError(shot.name, "fps", fmt::format("{}", *shot.fps), "frames per second, above 0");
  if (!(shot.gravity >= 0.0 && std::isfinite(shot.gravity))) throw InputError(shot.name, "gravity", fmt::format("{}", shot.gravity), "m/s², from 0");
  const std::array<Solid, 2> solids = {solid_of(shot.bodies[0], shot.name), solid_of(shot.bodies[1], shot.name)};
  check_drag(shot, options, solids);
  Evidence evidence = observe(shot, context, summary);
  Tracks& tracks = evidence.tracks;
  warn_of_footage(evidence.footage, context);
  summary.counts = {{"points", tracks.points.size()}, {"flights", tracks.spans.size()}, {"meetings", tracks.meetings.size()}};
  result.camera = evidence.camera.camera;
  result.fps = evidence.fps;
  result.T_world_camera = world_of(shot.down.value_or(Vec3::UnitY()), shot.gravity == 0.0);
  if (shot.bodies[1].shape == Shape::fixed) result.fixed = shot.bodies[1].name;
  for (const Body& body : shot.bodies) result.bodies.push_back({body.name, body.shape == Shape::fixed, Vec3::Zero(), {}, {}});

  warn_of_unused(shot, tracks, context);
  std::vector<SolvedImpact> impacts;
  {
    const Stage stage(context, summary, "positions");
    impacts = explain_positions(shot, options, solids, evidence, context);
    result.camera = evidence.camera.camera;
  }
  {
    const Stage stage(context, summary, "orientations");
    for (SolvedImpact& impact : impacts) solve_turning(shot, options, evidence.camera, evidence.footage, tracks, impact, context);
  }
  if (options.shared_restitution) share_restitution(impacts);
  {
    const Stage stage(context, summary, "uncertainty");
    for (SolvedImpact& impact : impacts) {
      impact.uncertain = uncertainty(impact.solution, options.resamples, options.seed, context);
      weigh_common_error(impact.solution, impact.uncertain, options.resamples, options.seed, context);
      impact.check = check_model(impact.solution, options.held_out, tracks.noise, {shot.bodies[0].name, shot.bodies[1].name});
      warn_of_held(shot, evidence, impact.solution.problem, context);
    }
    warn_of_common_bend(shot, tracks, impacts, context);
  }
  if (impacts.empty()) {
    summary.status = Status::infeasible;
    context.warn(nothing_found(shot, tracks));
    result.sighted = sighted_in(evidence.footage, tracks);
    warn_of_far_sightings(shot, evidence.fps, context);
    return;
  }
  result.bodies.clear();
  describe(shot, tracks, evidence.fps, impacts, result);
  remark_on(shot, options, tracks, impacts, result, context);
  warn_of_dimmed(shot, evidence.footage, tracks, context);
  if (result.restitution) return;
  summary.status = Status::infeasible;
  warn_of_far_sightings(shot, evidence.fps, context);
}

}  // namespace

Reconstruction reconstruct(const Shot& shot, const Options& options, Context& context) {
  check_options(options);
  terms_of(options.physics, options.without);  // an unknown term is told before any work
  Reconstruction result;
  try {
    reconstruct_into(shot, options, context, result);
  } catch (const Cancelled&) {
    result.summary.status = Status::cancelled;
  }
  result.summary.warnings = context.take_warnings();
  return result;
}

}  // namespace unseen::collision
