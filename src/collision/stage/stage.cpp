// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/stage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "collision/stage/stage_world.h"

namespace unseen::collision {
namespace {

/// Collisions whose bodies meet those of others, though nobody said how heavy they are.
std::set<std::string> of_unknown_mass(const Cast& cast, const std::vector<StagedImpact>& impacts, const StagePlan& plan) {
  std::set<std::string> names;
  for (const StagedImpact& impact : impacts) {
    if (impact.between[1] < 0) continue;  // a wall
    const CastActor &a = cast.actors[static_cast<std::size_t>(impact.between[0])], &b = cast.actors[static_cast<std::size_t>(impact.between[1])];
    if (a.collision == b.collision) continue;
    for (const CastActor* actor : {&a, &b})
      if (!actor->mass_known) names.insert(plan.collisions[static_cast<std::size_t>(actor->collision)].name);
  }
  return names;
}

}  // namespace

StagedShot stage(const StagePlan& plan, Context& context) {
  StagedShot shot;
  shot.fps = plan.fps;
  shot.gravity = plan.gravity;
  Cast cast = cast_of(plan, context);
  {
    const Stage stage(context, shot.summary, "meetings");
    arrange_meetings(cast, plan, context);
  }
  {
    const Stage stage(context, shot.summary, "simulate");
    StageRun run = simulate(cast, plan.fps, plan.duration, context);
    shot.frames = std::move(run.frames);
    shot.impacts = std::move(run.impacts);
  }
  for (const std::string& line : missed(cast, shot.impacts, 1.0 / plan.fps, plan.duration)) {
    context.warn(line);
    shot.summary.status = Status::infeasible;
  }
  if (const auto names = of_unknown_mass(cast, shot.impacts, plan); !names.empty())
    context.warn(fmt::format("{}: no mass is given, so the first body of each is taken to have 1 kg where bodies of others are met (\"mass\")", fmt::join(names, ", ")));
  for (const CastActor& actor : cast.actors) shot.actors.push_back(actor.actor);
  shot.walls = cast.walls;
  shot.placements = cast.placements;
  const Reconstruction& first = plan.collisions.front().result;
  shot.camera = first.camera;
  shot.T_world_camera = shot.placements.front().T_new_filmed * first.T_world_camera;
  shot.summary.counts = {{"bodies", shot.actors.size()}, {"impacts", shot.impacts.size()}, {"frames", shot.frames.size()}};
  shot.summary.warnings = context.take_warnings();
  return shot;
}

}  // namespace unseen::collision
