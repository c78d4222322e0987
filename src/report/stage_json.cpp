// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "report/collision_parts.h"
#include "report/stage_motion.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/collision_truth.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {
namespace {

using namespace collision;

Json actor_json(const StagedShot& shot, std::size_t i) {
  const Actor& a = shot.actors[i];
  Json json = {{"name", a.name}};
  if (a.body.shape == Shape::box)
    json["box"] = vector_of(a.body.box);
  else if (a.body.shape == Shape::sphere)
    json["sphere"] = number(a.body.radius);
  else
    json["mesh"] = actor_file(shot, i);
  json["mass"] = number(a.mass);
  json["inertia"] = vector_of(a.inertia);
  json["restitution"] = number(a.restitution);
  json["friction"] = number(a.friction);
  return json;
}

Json impact_json(const StagedShot& shot, const StagedImpact& i) {
  return {{"time", number(i.time)},
          {"between", {staged_name(shot, i.between[0]), staged_name(shot, i.between[1])}},
          {"restitution", number(i.restitution)},
          {"expected", number(i.expected)},
          {"approach", number(i.approach)},
          {"contact_point", vector_of(i.contact_point)},
          {"normal", vector_of(i.normal)}};
}

Json placement_json(const Placement& at) {
  return {{"name", at.name},
          {"result", at.file},
          {"time", number(at.time)},
          {"translate", vector_of(at.translate)},
          {"rotate_z_deg", degrees_of(at.turn)},
          {"T_new_filmed", matrix_of(at.T_new_filmed)}};
}

Json wall_json(const StagedShot& shot, const Wall& w) {
  const Json collision = w.collision < 0 ? Json(nullptr) : Json(shot.placements.at(static_cast<std::size_t>(w.collision)).name);
  return {{"name", w.name}, {"collision", collision}, {"normal", vector_of(w.plane.normal)}, {"offset", number(w.plane.offset)}};
}

Json frame_json(const StagedFrame& f) {
  Json json = {{"t", number(f.time)}};
  json["bodies"] = list_of(f.bodies, [](const BodyState& s, std::size_t) -> Json { return {{"p", vector_of(s.p)}, {"q", quaternion_of(s.q)}}; });
  return json;
}

}  // namespace

std::string actor_file(const StagedShot&, std::size_t actor) { return fmt::format("actor-{}.obj", actor); }

std::string actor_obj(const StagedShot& shot, std::size_t actor) {
  Body body = shot.actors.at(actor).body;
  body.mesh = body_mesh(body, body.name);
  return body_obj(body);
}

std::string stage_json(const StagedShot& shot, const InputRecord& input) {
  Json json = result_header("stage", input, {}, shot.summary);
  json["T_world_camera"] = matrix_of(shot.T_world_camera);
  json["camera"] = camera_of(shot.camera);
  json["fps"] = number(shot.fps);
  json["gravity"] = number(shot.gravity);
  json["collisions"] = list_of(shot.placements, [](const Placement& at, std::size_t) { return placement_json(at); });
  json["bodies"] = list_of(shot.actors, [&](const Actor&, std::size_t i) { return actor_json(shot, i); });
  json["walls"] = list_of(shot.walls, [&](const Wall& w, std::size_t) { return wall_json(shot, w); });
  json["impacts"] = list_of(shot.impacts, [&](const StagedImpact& i, std::size_t) { return impact_json(shot, i); });
  json["frames"] = list_of(shot.frames, [](const StagedFrame& f, std::size_t) { return frame_json(f); });
  return text_of(json);
}

}  // namespace unseen::report
