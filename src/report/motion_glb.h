// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "report/collision_motion.h"
#include "report/glb_builder.h"
#include "unseen/core/mesh.h"

// What the animations of collisions and of staged shots are made of.
namespace unseen::report {

/// A node that moves.
void add_moving(GlbBuilder& b, const std::string& name, const TriangleMesh& mesh, const Motion& motion, const Rgb& color);

/// Something fixed, translucent; nothing without corners.
void add_quad(GlbBuilder& b, const std::string& name, const std::vector<Vec3>& corners);

/// Nothing for a camera of unknown size.
void add_camera(GlbBuilder& b, const RigidTransform& T_world_camera, const Camera& camera);

}  // namespace unseen::report
