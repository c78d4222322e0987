// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/evidence.h"

#include <utility>
#include <vector>

#include "collision/shot_problem.h"
#include "collision/tracks/rolling_shutter.h"
#include "unseen/core/error.h"

namespace unseen::collision {

Tracks follow(const Shot& shot, const Footage& footage, const ShotCamera& camera, double fps, Context& context) {
  if (!shot.video.empty()) return with_rolling_shutter(find_tracks(shot, camera, footage, context), camera, footage.turn);
  std::vector<Sighting> sightings = shot.observations;
  if (shot.frames) std::erase_if(sightings, [&](const Sighting& s) { return s.frame < (*shot.frames)[0] || s.frame > (*shot.frames)[1]; });
  return with_rolling_shutter(find_tracks(shot, camera, sightings, fps, context), camera, 0);
}

Evidence observe(const Shot& shot, Context& context, Summary& summary) {
  Evidence evidence;
  if (shot.video.empty()) {
    if (!shot.fps) throw InputError(shot.name, "fps", "nothing", "the frame rate of the observations");
    evidence.fps = *shot.fps;
  } else {
    const Stage stage(context, summary, "regions");
    evidence.footage = find_regions(shot, context);
    evidence.fps = evidence.footage.fps;
  }
  const Stage stage(context, summary, "tracks");
  evidence.camera = complete_camera(shot, evidence.footage.width, evidence.footage.height);
  check_readout(shot, evidence.footage, evidence.fps);
  evidence.tracks = follow(shot, evidence.footage, evidence.camera, evidence.fps, context);
  return evidence;
}

}  // namespace unseen::collision
