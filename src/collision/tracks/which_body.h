// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// Exchanges the labels of two free bodies if their silhouettes ask for it, and notes whether these tell the bodies apart: the
/// match of each outline with each body from all sides, and the distances that follow from it, which change evenly along a flight (of sides that
/// match alike that one counts whose distance does) and are those of bodies that touch when they meet. Does nothing for two spheres, whose size alone tells.
void label_by_shape(const Shot& shot, const ShotCamera& camera, const Footage& footage, Tracks& tracks);

}  // namespace unseen::collision
