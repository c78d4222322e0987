// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/collision_truth.h"

#include <fmt/format.h>

#include "report/collision_parts.h"

namespace unseen::report {
namespace {

using namespace collision;

Json body_of(const Body& b) {
  Json json = {{"name", b.name}};
  switch (b.shape) {
    case Shape::mesh: json["mesh"] = b.name + ".obj"; break;
    case Shape::box: json["box"] = vector_of(b.box); break;
    case Shape::sphere: json["sphere"] = number(b.radius); break;
    case Shape::size: json["size"] = number(b.size); break;
    case Shape::fixed: json["fixed"] = true; break;
  }
  if (b.normal) json["normal"] = vector_of(*b.normal);
  if (b.mass) json["mass"] = number(*b.mass);
  return json;
}

Json bodies_of(const std::vector<Body>& bodies) {
  return list_of(bodies, [](const Body& b, std::size_t) { return body_of(b); });
}

/// In the form of a result's estimates.
Json exactly(double value) { return {{"value", number(value)}, {"sd", 0.0}}; }

Json true_frame_of(const FramePose& f) {
  Json json = {{"frame", f.frame}, {"t", number(f.time)}};
  for (int b = 0; b < 2; ++b)
    if (f.bodies[b]) json[kBodyKeys[b]] = state_of(*f.bodies[b]);
  return json;
}

}  // namespace

std::string collision_truth_json(const Truth& truth, const OptionTable& options) {
  Json json = made_by("synth collision", options);
  json["scene"] = truth.scene;
  json["T_world_camera"] = matrix_of(truth.T_world_camera);
  json["camera"] = camera_of(truth.camera);
  json["fps"] = number(truth.fps);
  json["bodies"] = bodies_of(truth.bodies);
  json["impacts"] = list_of(truth.impacts, [&](const Impact& i, std::size_t) { return impact_of(i, exactly(i.restitution.value), {truth.bodies.at(0).name, truth.bodies.at(1).name}); });
  json["restitution"] = or_null(truth.restitution, exactly);
  json["mass_ratio"] = or_null(truth.mass_ratio, exactly);
  json["frames"] = list_of(truth.frames, [](const FramePose& f, std::size_t) { return true_frame_of(f); });
  return text_of(json);
}

std::string collision_shot_json(const Shot& shot) {
  Json json;
  if (shot.video.empty())
    json["observations"] = "observations.json";
  else
    json["video"] = shot.video;
  if (shot.fps) json["fps"] = number(*shot.fps);
  json["camera"] = camera_of(shot.camera.camera);
  json["gravity"] = number(shot.gravity);
  if (shot.down) json["down"] = vector_of(*shot.down);
  json["bodies"] = bodies_of(shot.bodies);
  if (shot.floor) json["floor"] = {{"normal", vector_of(shot.floor->normal)}, {"offset", number(shot.floor->offset)}};
  if (shot.metres_per_pixel) json["metres_per_pixel"] = number(*shot.metres_per_pixel);
  if (!shot.orientations.empty())
    json["orientations"] = list_of(shot.orientations, [&](const OrientationHint& o, std::size_t) -> Json {
      return {{"body", shot.bodies.at(static_cast<std::size_t>(o.body)).name}, {"t", number(o.time)}, {"q", quaternion_of(o.q)}};
    });
  return text_of(json);
}

std::string collision_sightings_json(const Shot& shot) {
  return text_of(list_of(shot.observations, [&](const Sighting& s, std::size_t) -> Json {
    Json json = {{"frame", s.frame}, {"x", number(s.pixel.x())}, {"y", number(s.pixel.y())}};
    if (s.radius > 0) json["radius"] = number(s.radius);
    if (s.body >= 0) json["label"] = shot.bodies.at(static_cast<std::size_t>(s.body)).name;
    return json;
  }));
}

std::string body_obj(const Body& body) {
  std::string text = "o " + body.name + "\n";
  for (const Vec3& v : body.mesh.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : body.mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

}  // namespace unseen::report
