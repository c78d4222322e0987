// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "report/collision_motion.h"
#include "unseen/collision/stage.h"

namespace unseen::report {

/// An actor's poses; neighbouring quaternions have the same sign.
Motion motion_of(const collision::StagedShot& shot, std::size_t actor);

/// Four corners of a wall, as wide as what can hit it needs.
std::vector<Vec3> wall_quad(const collision::StagedShot& shot, std::size_t wall);

/// "one.ball"; −1 − w is wall w.
const std::string& staged_name(const collision::StagedShot& shot, int actor_or_wall);

}  // namespace unseen::report
