// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/doubts/model_check.h"
#include "collision/doubts/uncertainty.h"
#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// One impact with all that was found out about it.
struct SolvedImpact {
  Tracks::Meeting meeting;
  Solution solution;
  Uncertain uncertain;
  ModelCheck check;
};

/// Camera to world: z against gravity, y along the camera's forward direction (or the image's up, if that is within 5° of the vertical).
RigidTransform world_of(const Vec3& down, bool planar);

/// Writes what was solved into the result. The first impact gives the whole shot's states; restitution is pooled over all that fit.
void describe(const Shot& shot, const Tracks& tracks, double fps, const std::vector<SolvedImpact>& impacts, Reconstruction& result);

}  // namespace unseen::collision
