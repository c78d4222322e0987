// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/stage.h"

#include "collision/stage_world.h"

namespace unseen::collision {

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
