// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/moving_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "unseen/collision/body_mesh.h"

namespace unseen::report {
namespace {

using namespace collision;

std::vector<std::array<int, 3>> triangles_of(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : mesh.triangles) triangles.push_back({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  return triangles;
}

}  // namespace

Json ball_shape(double diameter) { return {{"kind", "sphere"}, {"size", {number(diameter), number(diameter), number(diameter)}}}; }

Json shape_of(SceneBuilder& scene, const Body& body, std::size_t id) {
  if (body.shape == Shape::box) return {{"kind", "box"}, {"size", vector_of(body.box)}};
  if (body.shape != Shape::mesh) return ball_shape(largest_extent(body));
  const TriangleMesh mesh = body_mesh(body, body.name);
  const std::string name = fmt::format("mesh-{}", id);
  Json& structure = scene.add("mesh", name, fmt::format("Mesh of {}", body.name));
  structure["visible"] = false;
  structure["vertices"] = scene.vectors(mesh.vertices);
  structure["triangles"] = scene.triples(triangles_of(mesh));
  return {{"kind", "mesh"}, {"mesh", name}};
}

void add_moving(SceneBuilder& scene, const std::vector<Moving>& bodies) {
  if (bodies.empty()) return;
  std::set<double> all_times;
  for (const Moving& body : bodies) all_times.insert(body.motion.times.begin(), body.motion.times.end());
  const std::vector<float> times(all_times.begin(), all_times.end());
  std::vector<float> rotations;
  std::vector<Vec3> positions;
  std::vector<int> colors;
  std::vector<std::string> names;
  Json shapes = Json::array();
  for (const Moving& body : bodies) {
    for (const double t : all_times) {
      positions.push_back(body.motion.position(t));
      const Quat q = body.motion.rotation(t);
      for (const double c : {q.w(), q.x(), q.y(), q.z()}) rotations.push_back(static_cast<float>(c));
    }
    shapes.push_back(body.shape);
    colors.push_back(body.color);
    if (names.size() <= static_cast<std::size_t>(body.color)) names.resize(static_cast<std::size_t>(body.color) + 1);
    names[static_cast<std::size_t>(body.color)] = body.name;
  }
  Json& structure = scene.add("trajectory", "bodies", "Bodies");
  structure["times"] = scene.scalars(times);
  structure["positions"] = scene.positions(positions);
  structure["rotations"] = scene.quaternions(rotations);
  structure["shapes"] = std::move(shapes);
  Json label = quantity("body", "Body", "label", scene.integers(colors));
  label["names"] = names;
  structure["quantities"].push_back(label);
  scene.header["time"] = {{"start", number(times.front())}, {"end", number(times.back())}};
  constexpr double kShortest = 4.0;  // s: what is over sooner is played in slow motion
  const double duration = times.back() - times.front();
  if (duration < kShortest) scene.header["time"]["rate"] = number(duration / kShortest);
}

void add_quad(SceneBuilder& scene, const std::string& id, const std::string& name, const std::vector<Vec3>& corners) {
  if (corners.empty()) return;
  Json& quad = scene.add("mesh", id, name);
  quad["vertices"] = scene.positions(corners);
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  quad["triangles"] = scene.triples(triangles);
}

}  // namespace unseen::report
