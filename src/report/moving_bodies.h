// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "report/collision_motion.h"
#include "report/scene_builder.h"

// What the pages of collisions and of staged shots have in common.
namespace unseen::report {

/// Something that the page's time moves.
struct Moving {
  std::string name;
  int color = 0;
  Motion motion;  ///< with at least one key
  Json shape;
};

/// The shape of a body for `Moving`; a mesh becomes a structure "mesh-ID" of its own, out of sight.
Json shape_of(SceneBuilder& scene, const collision::Body& body, std::size_t id);
Json ball_shape(double diameter);

/// The structure "bodies", and the page's time, in slow motion if it is short.
void add_moving(SceneBuilder& scene, const std::vector<Moving>& bodies);

/// A translucent face of four corners; nothing without corners.
void add_quad(SceneBuilder& scene, const std::string& id, const std::string& name, const std::vector<Vec3>& corners);

}  // namespace unseen::report
