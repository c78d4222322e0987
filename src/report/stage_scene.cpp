// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "report/moving_bodies.h"
#include "report/scene_builder.h"
#include "report/stage_motion.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {
namespace {

using namespace collision;

void add_actors(SceneBuilder& scene, const StagedShot& shot) {
  std::vector<Moving> bodies;
  for (std::size_t i = 0; i < shot.actors.size(); ++i)
    bodies.push_back({shot.actors[i].name, static_cast<int>(i), motion_of(shot, i), shape_of(scene, shot.actors[i].body, i)});
  add_moving(scene, bodies);
}

/// A segment a frame and body, in the body's colour.
void add_paths(SceneBuilder& scene, const StagedShot& shot) {
  std::vector<Vec3> ends;
  std::vector<int> body;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < shot.actors.size(); ++i) {
    names.push_back(shot.actors[i].name);
    for (std::size_t f = 0; f + 1 < shot.frames.size(); ++f) {
      ends.push_back(shot.frames[f].bodies[i].p);
      ends.push_back(shot.frames[f + 1].bodies[i].p);
      body.push_back(static_cast<int>(i));
    }
  }
  if (body.empty()) return;
  Json& lines = scene.add("lines", "flights", "Flights");
  lines["vertices"] = scene.positions(ends);
  Json label = quantity("body", "Body", "label", scene.integers(body));
  label["names"] = names;
  lines["quantities"] = {label};
}

/// The normal at each impact, as long as the two approach fast.
void add_normals(SceneBuilder& scene, const StagedShot& shot) {
  if (shot.impacts.empty()) return;
  std::vector<Vec3> origins, vectors;
  std::vector<int> on;
  std::vector<std::string> names;
  for (const Actor& a : shot.actors) names.push_back("on " + a.name);
  for (const StagedImpact& i : shot.impacts)
    for (const auto& [body, sign] : {std::pair(i.between[0], 1.0), std::pair(i.between[1], -1.0)}) {
      if (body < 0) continue;
      origins.push_back(i.contact_point);
      vectors.push_back(sign * i.approach * i.normal);
      on.push_back(body);
    }
  Json& arrows = scene.add("arrows", "impacts", "Impacts");
  arrows["origins"] = scene.positions(origins);
  arrows["vectors"] = scene.vectors(vectors);
  Json label = quantity("on", "On what", "label", scene.integers(on));
  label["names"] = names;
  arrows["quantities"] = {label};
}

void add_tables(SceneBuilder& scene, const StagedShot& shot) {
  Json impacts = Json::array(), bodies = Json::array(), collisions = Json::array();
  for (const StagedImpact& i : shot.impacts)
    impacts.push_back({number(i.time), staged_name(shot, i.between[0]), staged_name(shot, i.between[1]), number(i.restitution), number(i.expected), number(i.approach)});
  for (const Actor& a : shot.actors) bodies.push_back({a.name, number(a.mass), number(largest_extent(a.body)), number(a.restitution), number(a.friction)});
  for (const Placement& p : shot.placements)
    collisions.push_back({p.name, number(p.time), fmt::format("{:.2f}, {:.2f}, {:.2f}", p.translate.x(), p.translate.y(), p.translate.z()), degrees_of(p.turn), p.file});
  add_table(scene, "Impacts",
            {column("time", "s", 4), column("of"), column("and"), column("restitution", "", 3), column("of the estimate", "", 3), column("approach", "m/s", 2)},
            std::move(impacts));
  add_table(scene, "Bodies", {column("body"), column("mass", "kg", 3), column("extent", "m", 3), column("√restitution", "", 3), column("√friction", "", 3)}, std::move(bodies));
  add_table(scene, "Collisions", {column("collision"), column("at", "s", 3), column("moved", "m"), column("turned", "°", 1), column("result")}, std::move(collisions));
}

void add_facts(SceneBuilder& scene, const StagedShot& shot) {
  double off = 0;
  for (const StagedImpact& i : shot.impacts) off = std::max(off, std::abs(i.restitution - i.expected));
  add_fact(scene, "collisions", std::to_string(shot.placements.size()));
  add_fact(scene, "bodies", std::to_string(shot.actors.size()));
  add_fact(scene, "impacts", std::to_string(shot.impacts.size()));
  add_fact(scene, "happened as asked", shot.summary.status == Status::infeasible ? "no" : "yes");
  if (!shot.impacts.empty()) add_fact(scene, "restitution off by at most", fmt::format("{:.3f}", off));
  add_fact(scene, "duration", fmt::format("{:.2f} s", shot.frames.back().time));
  add_fact(scene, "frames a second", fmt::format("{:g}", shot.fps));
}

Json focus_of(const StagedShot& shot) {
  Eigen::AlignedBox3d reach;
  for (const StagedFrame& f : shot.frames)
    for (const BodyState& body : f.bodies) reach.extend(body.p);
  const Vec3 margin = Vec3::Constant(std::max(0.05, 0.15 * reach.sizes().maxCoeff()));
  return {{"low", vector_of(reach.min() - margin)}, {"high", vector_of(reach.max() + margin)}};
}

}  // namespace

std::string stage_scene(const StagedShot& shot, const InputRecord& input, const std::string& command) {
  SceneBuilder scene(Vec3::Zero());
  scene.header["title"] = stage_title(input);
  write_run(scene, "stage", command, shot.summary, {}, input);
  scene.header["inside"] = false;
  scene.header["focus"] = focus_of(shot);
  scene.header["about"] = "Collisions of several results in one shot, run by a physics engine from the states that were solved for, so that they happen at the times asked for.";
  add_facts(scene, shot);
  add_actors(scene, shot);
  for (std::size_t w = 0; w < shot.walls.size(); ++w) add_quad(scene, fmt::format("wall-{}", w), shot.walls[w].name, wall_quad(shot, w));
  add_paths(scene, shot);
  add_normals(scene, shot);
  if (shot.camera.fx > 0 && shot.camera.width > 0) write_camera(scene.add("camera", "camera", "Camera of the first"), shot.T_world_camera, shot.camera);
  add_tables(scene, shot);
  return scene.encode();
}

std::string stage_title(const InputRecord& input) {
  const std::string name = std::filesystem::path(input.path).filename().string();
  return "Shot staged from " + (name.empty() ? input.path : name);
}

}  // namespace unseen::report
