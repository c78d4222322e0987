// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>

#include "report/collision_parts.h"
#include "report/collision_shot_parts.h"
#include "report/stage_motion.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {
namespace {

using namespace collision;

Placement placement(const JsonField& json) {
  Placement at;
  at.name = json["name"].text();
  at.file = json["result"].text();
  at.time = json["time"].number(0);
  at.translate = json["translate"].vector();
  at.turn = radians(json["rotate_z_deg"].number());
  at.T_new_filmed = read_transform(json["T_new_filmed"]);
  return at;
}

Actor actor(const JsonField& json, const std::filesystem::path& folder) {
  Actor a;
  a.name = a.body.name = json["name"].text();
  if (json.has("box") + json.has("sphere") + json.has("mesh") != 1) json.fail("one of box, sphere and mesh");
  read_shape(a.body, json, folder);
  a.mass = json["mass"].number(0);
  a.inertia = json["inertia"].vector();
  a.restitution = json["restitution"].number(0, 1);
  a.friction = json["friction"].number(0);
  return a;
}

Wall wall(const JsonField& json, const std::vector<Placement>& placements) {
  Wall w;
  w.name = json["name"].text();
  w.plane = {json["normal"].unit_vector(), json["offset"].number()};
  const JsonField collision = json["collision"];
  if (collision.is_null()) return w;
  const auto at = std::find_if(placements.begin(), placements.end(), [&](const Placement& p) { return p.name == collision.text(); });
  if (at == placements.end()) collision.fail("the name of a collision, or null");
  w.collision = static_cast<int>(at - placements.begin());
  return w;
}

/// The actor or wall of that name.
int staged(const JsonField& json, const StagedShot& shot) {
  const std::string name = json.text();
  for (int i = -static_cast<int>(shot.walls.size()); i < static_cast<int>(shot.actors.size()); ++i)
    if (staged_name(shot, i) == name) return i;
  json.fail("the name of a body or a wall");
}

StagedImpact impact(const JsonField& json, const StagedShot& shot) {
  const auto between = json["between"].list();
  if (between.size() != 2) json["between"].fail("two names");
  StagedImpact i;
  i.time = json["time"].number(0);
  i.between = {staged(between[0], shot), staged(between[1], shot)};
  if (i.between[0] < 0) between[0].fail("the name of a body");
  i.restitution = json["restitution"].number();
  i.expected = json["expected"].number(0, 1);
  i.approach = json["approach"].number(0);
  i.contact_point = json["contact_point"].vector();
  i.normal = json["normal"].unit_vector();
  return i;
}

StagedFrame frame(const JsonField& json, std::size_t bodies) {
  StagedFrame f;
  f.time = json["t"].number(0);
  for (const JsonField& body : json["bodies"].list(bodies))
    f.bodies.push_back({body["p"].vector(), Vec3::Zero(), Vec3::Zero(), read_unit_quaternion(body["q"])});
  if (f.bodies.size() != bodies) json["bodies"].fail(fmt::format("{}, as there are bodies", bodies));
  return f;
}

}  // namespace

StagedShot read_stage_result(const std::filesystem::path& path) {
  const std::string text = read_result_text(path);
  const nlohmann::json parsed = parse_json(text, path.string());
  const JsonField json(parsed, path.string());
  if (json["schema"].count() != 1) json["schema"].fail("1");
  if (json["capability"].text() != "stage") json["capability"].fail("\"stage\"");
  StagedShot shot;
  shot.summary = read_summary(json["summary"], text);
  shot.T_world_camera = read_transform(json["T_world_camera"]);
  shot.camera = read_camera(json["camera"]);
  shot.fps = json["fps"].number(0);
  shot.gravity = json["gravity"].number(0);
  for (const JsonField& field : json["collisions"].list()) shot.placements.push_back(placement(field));
  for (const JsonField& field : json["bodies"].list()) shot.actors.push_back(actor(field, path.parent_path()));
  for (const JsonField& field : json["walls"].list()) shot.walls.push_back(wall(field, shot.placements));
  for (const JsonField& field : json["impacts"].list()) shot.impacts.push_back(impact(field, shot));
  for (const JsonField& field : json["frames"].list()) {
    shot.frames.push_back(frame(field, shot.actors.size()));
    if (shot.frames.size() > 1 && !(shot.frames.back().time > shot.frames[shot.frames.size() - 2].time)) field["t"].fail("later than the frame before");
  }
  if (shot.actors.empty()) json["bodies"].fail("at least one");
  if (shot.frames.empty()) json["frames"].fail("at least one");
  return shot;
}

}  // namespace unseen::report
