// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_motion.h"
#include "report/motion_glb.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/collision_files.h"

namespace unseen::report {
namespace {

using namespace collision;

void add_body(GlbBuilder& b, const Shot& shot, const Reconstruction& r, int body) {
  const Motion motion = motion_of(r, body, shot.gravity);
  if (motion.times.empty()) return;
  const TriangleMesh mesh = body_mesh(shot.bodies[static_cast<std::size_t>(body)], shot.name);
  if (mesh.triangles.empty()) return;
  add_moving(b, name_of(r, body), mesh, motion, frame_color(body));
}

}  // namespace

std::string collision_glb(const Shot& shot, const Reconstruction& r) {
  GlbBuilder b(Vec3::Zero());
  add_quad(b, r.fixed.empty() ? "floor" : r.fixed, fixed_quad(shot, r));
  for (std::size_t body = 0; body < shot.bodies.size(); ++body) add_body(b, shot, r, static_cast<int>(body));
  add_camera(b, r.T_world_camera, r.camera);
  return b.finish();
}

}  // namespace unseen::report
