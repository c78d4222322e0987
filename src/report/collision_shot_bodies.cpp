// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "report/collision_shot_parts.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/error.h"
#include "unseen/io/mesh.h"

namespace unseen::report {
namespace {

using collision::Body;
using collision::Shape;

// What is thrown before a camera: beyond these, the unit is wrong.
constexpr double kSmallest = 1e-4, kLargest = 10.0;   // m
constexpr double kLightest = 1e-6, kHeaviest = 1e5;  // kg

double length(const JsonField& json) {
  const double metres = json.number();
  if (!(metres >= kSmallest && metres <= kLargest)) json.fail(fmt::format("a length of {} to {} m", kSmallest, kLargest));
  return metres;
}

void read_mesh(Body& body, const JsonField& json, const std::filesystem::path& path) {
  body.shape = Shape::mesh;
  body.mesh = io::read_mesh(path);
  body.mesh.labels.clear();
  if (body.mesh.triangles.empty()) throw InputError(path.string(), "", "no triangles", "a closed mesh");
  const double extent = collision::largest_extent(body);
  if (!(extent >= kSmallest && extent <= kLargest))
    throw InputError(json.source(), json.path(), fmt::format("a mesh {:.4g} m long", extent),
                     fmt::format("{} to {} m; meshes are taken as metres", kSmallest, kLargest));
}

}  // namespace

void read_shape(Body& body, const JsonField& json, const std::filesystem::path& folder) {
  if (json.has("mesh")) {
    read_mesh(body, json["mesh"], io::named_file(json, "mesh", folder));
  } else if (json.has("box")) {
    body.shape = Shape::box;
    body.box = json["box"].vector();
    for (const JsonField& edge : json["box"].list()) (void)length(edge);
  } else if (json.has("sphere")) {
    body.shape = Shape::sphere;
    body.radius = length(json["sphere"]);
  } else if (json.has("size")) {
    body.shape = Shape::size;
    body.size = length(json["size"]);
  } else {
    body.shape = Shape::fixed;
    if (!json["fixed"].truth()) json["fixed"].fail("true; a body that moves has mesh, box, sphere or size");
  }
}

Vec3 read_direction(const JsonField& json) {
  const Vec3 v = json.vector();
  if (!(v.norm() > 1e-6 && v.norm() < 1e6)) json.fail("a direction: three numbers that are not all 0");
  return v.normalized();
}

Body read_body(const JsonField& json, const std::filesystem::path& folder) {
  json.allow_only({"name", "mesh", "box", "sphere", "size", "fixed", "normal", "mass"});
  Body body;
  body.name = json["name"].text();
  if (body.name.empty()) json["name"].fail("a name");
  int shapes = 0;
  for (const char* key : {"mesh", "box", "sphere", "size", "fixed"}) shapes += json.has(key);
  if (shapes != 1)
    throw InputError(json.source(), json.path(), fmt::format("{} of them", shapes),
                     "one of mesh (a file), box (three edges, m), sphere (radius, m), size (largest extent, m) and fixed (true)");
  read_shape(body, json, folder);
  const bool fixed = body.shape == Shape::fixed;
  if (json.has("normal")) {
    if (!fixed) json["normal"].fail("none: only what is fixed has one");
    body.normal = read_direction(json["normal"]);
  }
  if (json.has("mass")) {
    if (fixed) json["mass"].fail("none: what is fixed has no mass that matters");
    body.mass = json["mass"].number(kLightest, kHeaviest);
  }
  return body;
}

int free_body(const JsonField& name, const std::vector<Body>& bodies) {
  const std::string text = name.text();
  std::string known;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].shape == Shape::fixed) continue;
    if (bodies[i].name == text) return static_cast<int>(i);
    known += (known.empty() ? "" : " or ") + bodies[i].name;
  }
  name.fail("a body that moves: " + known);
}

}  // namespace unseen::report
