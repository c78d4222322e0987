// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>

#include "report/collision_motion.h"
#include "report/glb_builder.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/collision_files.h"

namespace unseen::report {
namespace {

using namespace collision;

constexpr Rgb kFixedColor = {200, 200, 195};
constexpr double kFixedOpacity = 0.6;

tinygltf::Primitive surface(GlbBuilder& b, const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles, int material) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  primitive.attributes["POSITION"] = b.add_positions(vertices);
  primitive.indices = b.add_triangles(triangles);
  return primitive;
}

void add_body(GlbBuilder& b, const Shot& shot, const Reconstruction& r, int body) {
  const Motion motion = motion_of(r, body, shot.gravity);
  if (motion.times.empty()) return;
  const TriangleMesh mesh = body_mesh(shot.bodies[static_cast<std::size_t>(body)], shot.name);
  if (mesh.triangles.empty()) return;
  const std::string name = name_of(r, body);
  const int node = b.add_node(name, surface(b, mesh.vertices, mesh.triangles, b.add_material(name, frame_color(body))));
  b.add_motion(node, motion.times, motion.positions, motion.rotations);
}

void add_camera(GlbBuilder& b, const Reconstruction& r) {
  const Camera& c = r.camera;
  if (c.width <= 0 || c.height <= 0 || !(c.fx > 0) || !(c.fy > 0)) return;
  tinygltf::Camera camera;
  camera.name = "camera";
  camera.type = "perspective";
  camera.perspective.yfov = 2.0 * std::atan(0.5 * c.height / c.fy);
  camera.perspective.aspectRatio = c.width / c.fx * c.fy / c.height;
  camera.perspective.znear = 0.01;
  camera.perspective.zfar = 1000.0;
  b.model.cameras.push_back(camera);
  Mat3 axes = r.T_world_camera.rotation;  // glTF's cameras look along −z with y up
  axes.col(1) *= -1.0;
  axes.col(2) *= -1.0;
  const int node = b.add_empty_node("camera", r.T_world_camera.translation, Quat(axes));
  b.model.nodes[static_cast<std::size_t>(node)].camera = 0;
}

}  // namespace

std::string collision_glb(const Shot& shot, const Reconstruction& r) {
  GlbBuilder b(Vec3::Zero());
  if (const std::vector<Vec3> quad = fixed_quad(shot, r); !quad.empty()) {
    const std::string name = r.fixed.empty() ? "floor" : r.fixed;
    b.add_node(name, surface(b, quad, {{0, 1, 2}, {0, 2, 3}}, b.add_material(name, kFixedColor, kFixedOpacity)));
  }
  for (std::size_t body = 0; body < shot.bodies.size(); ++body) add_body(b, shot, r, static_cast<int>(body));
  add_camera(b, r);
  return b.finish();
}

}  // namespace unseen::report
