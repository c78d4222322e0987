// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/motion_glb.h"

#include <cmath>

namespace unseen::report {
namespace {

constexpr Rgb kFixedColor = {200, 200, 195};
constexpr double kFixedOpacity = 0.6;

}  // namespace

void add_moving(GlbBuilder& b, const std::string& name, const TriangleMesh& mesh, const Motion& motion, const Rgb& color) {
  const int node = b.add_node(name, b.surface(mesh.vertices, mesh.triangles, b.add_material(name, color)));
  b.add_motion(node, motion.times, motion.positions, motion.rotations);
}

void add_quad(GlbBuilder& b, const std::string& name, const std::vector<Vec3>& corners) {
  if (corners.empty()) return;
  b.add_node(name, b.surface(corners, {{0, 1, 2}, {0, 2, 3}}, b.add_material(name, kFixedColor, kFixedOpacity)));
}

void add_camera(GlbBuilder& b, const RigidTransform& T_world_camera, const Camera& c) {
  if (c.width <= 0 || c.height <= 0 || !(c.fx > 0) || !(c.fy > 0)) return;
  tinygltf::Camera camera;
  camera.name = "camera";
  camera.type = "perspective";
  camera.perspective.yfov = 2.0 * std::atan(0.5 * c.height / c.fy);
  camera.perspective.aspectRatio = c.width / c.fx * c.fy / c.height;
  camera.perspective.znear = 0.01;
  camera.perspective.zfar = 1000.0;
  b.model.cameras.push_back(camera);
  Mat3 axes = T_world_camera.rotation;  // glTF's cameras look along −z with y up
  axes.col(1) *= -1.0;
  axes.col(2) *= -1.0;
  const int node = b.add_empty_node("camera", T_world_camera.translation, Eigen::Quaterniond(axes));
  b.model.nodes[static_cast<std::size_t>(node)].camera = 0;
}

}  // namespace unseen::report
