// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/stage/stage_cast.h"

namespace unseen::collision {

struct StageRun {
  std::vector<StagedFrame> frames;
  std::vector<StagedImpact> impacts;
};

/// Simulates all flights and impacts from 0 to `duration` with Bullet, a frame each 1/fps s and one at each impact. Deterministic.
StageRun simulate(const Cast& cast, double fps, double duration, const Context& context);

}  // namespace unseen::collision
