// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/motion_glb.h"
#include "report/stage_motion.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {

using namespace collision;

std::string stage_glb(const StagedShot& shot) {
  GlbBuilder b(Vec3::Zero());
  for (std::size_t w = 0; w < shot.walls.size(); ++w) add_quad(b, shot.walls[w].name, wall_quad(shot, w));
  for (std::size_t i = 0; i < shot.actors.size(); ++i) {
    const Actor& actor = shot.actors[i];
    add_moving(b, actor.name, body_mesh(actor.body, actor.name), motion_of(shot, i), frame_color(static_cast<int>(i)));
  }
  add_camera(b, shot.T_world_camera, shot.camera);
  return b.finish();
}

}  // namespace unseen::report
