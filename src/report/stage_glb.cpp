// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "report/motion_glb.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {
namespace {

using namespace collision;

Motion motion_of(const StagedShot& shot, std::size_t actor) {
  Motion motion;
  for (const StagedFrame& f : shot.frames) {
    motion.times.push_back(f.time);
    motion.positions.push_back(f.bodies[actor].p);
    motion.rotations.push_back(f.bodies[actor].q);
  }
  keep_signs(motion);
  return motion;
}

/// As wide as what can hit it needs.
std::vector<Vec3> quad_of(const StagedShot& shot, int wall) {
  const Wall& w = shot.walls[static_cast<std::size_t>(wall)];
  std::vector<Vec3> points;
  double margin = 0;
  for (const StagedImpact& i : shot.impacts)
    if (i.between[1] == -1 - wall) points.push_back(i.contact_point);
  for (std::size_t a = 0; a < shot.actors.size(); ++a) {
    margin = std::max(margin, 2.0 * largest_extent(shot.actors[a].body));
    if (w.collision < 0)
      for (const StagedFrame& f : shot.frames) points.push_back(f.bodies[a].p);
  }
  return quad_below(w.plane, points, margin);
}

}  // namespace

std::string stage_glb(const StagePlan& plan, const StagedShot& shot) {
  GlbBuilder b(Vec3::Zero());
  for (std::size_t w = 0; w < shot.walls.size(); ++w) add_quad(b, shot.walls[w].name, quad_of(shot, static_cast<int>(w)));
  for (std::size_t i = 0; i < shot.actors.size(); ++i)
    add_moving(b, shot.actors[i].name, body_mesh(shot.actors[i].body, plan.name), motion_of(shot, i), frame_color(static_cast<int>(i)));
  const Reconstruction& first = plan.collisions.front().result;
  add_camera(b, shot.placements.front().T_new_filmed * first.T_world_camera, first.camera);
  return b.finish();
}

}  // namespace unseen::report
