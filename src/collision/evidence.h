// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/tracks.h"
#include "unseen/core/context.h"
#include "unseen/core/summary.h"

namespace unseen::collision {

/// What the film, or the sightings in its place, show.
struct Evidence {
  Footage footage;
  ShotCamera camera;
  Tracks tracks;
  double fps = 0;
};

/// Decodes the film, or takes the sightings in its place, and finds flights and meetings. Stages "regions" and "tracks" of the summary.
/// \throws InputError if sightings come without a frame rate.
Evidence observe(const Shot& shot, Context& context, Summary& summary);

/// Follows what moves, as this camera sees it.
Tracks follow(const Shot& shot, const Footage& footage, const ShotCamera& camera, double fps, Context& context);

}  // namespace unseen::collision
