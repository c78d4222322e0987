// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/stage_motion.h"

#include <algorithm>

#include "unseen/collision/body_mesh.h"

namespace unseen::report {

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

std::vector<Vec3> wall_quad(const StagedShot& shot, std::size_t wall) {
  const Wall& w = shot.walls[wall];
  std::vector<Vec3> points;
  double margin = 0;
  for (const StagedImpact& i : shot.impacts)
    if (i.between[1] == -1 - static_cast<int>(wall)) points.push_back(i.contact_point);
  for (std::size_t a = 0; a < shot.actors.size(); ++a) {
    margin = std::max(margin, 2.0 * largest_extent(shot.actors[a].body));
    if (w.collision < 0)
      for (const StagedFrame& f : shot.frames) points.push_back(f.bodies[a].p);
  }
  return quad_below(w.plane, points, margin);
}

const std::string& staged_name(const StagedShot& shot, int actor_or_wall) {
  return actor_or_wall >= 0 ? shot.actors.at(static_cast<std::size_t>(actor_or_wall)).name : shot.walls.at(static_cast<std::size_t>(-1 - actor_or_wall)).name;
}

}  // namespace unseen::report
