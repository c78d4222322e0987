// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>

#include "io/toml_file.h"
#include "report/collision_shot_parts.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/error.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_shot.h"
#include "unseen/report/stage_files.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace collision;

constexpr double kLongest = 60.0, kMostFps = 10000.0, kMostGravity = 100.0;  // s, frames/s, m/s²
constexpr double kFarthest = 1e4, kHeaviest = 1e5;                          // m, kg
constexpr int kMostRepeats = 100;
constexpr double kAfterMeeting = 0.5;  // s: what a shot without a duration shows of it

fs::path result_file(const fs::path& named) { return fs::is_directory(named) ? named / "result.json" : named; }

/// Whether a result goes by the name of its folder, and not of its file.
bool is_result(const fs::path& named) { return result_file(named).filename() == "result.json"; }

fs::path folder_of(const fs::path& result) { return fs::absolute(result_file(result)).lexically_normal().parent_path(); }

/// The shot that a result was made from, unless another file is named. Its path is relative to where the result was made: here, or in
/// a folder that holds the result's.
Shot shot_of(const fs::path& result, const fs::path& named) {
  if (!named.empty()) return read_shot(named);
  const InputRecord input = read_stored_run(result).input;
  const fs::path path = input.path;
  if (const fs::path found = find_input(result, input, {}); fs::is_regular_file(found)) return read_shot(found);
  throw InputError(result.string(), "input.path", path.string() + ", which does not exist", "the SHOT.json of the result; a shot list names it as shot = \"…\"");
}

StagedCollision read_collision(const fs::path& result, const fs::path& shot) {
  StagedCollision c;
  const fs::path file = result_file(result), folder = folder_of(result);
  if (!fs::is_regular_file(file)) throw InputError(file.string(), "file", "none", "the result of unseen collision");
  c.name = is_result(file) ? folder.filename().string() : file.stem().string();
  c.file = file.string();
  c.result = read_collision_result(file);
  c.shot = shot_of(file, shot);
  if (c.result.impacts.empty()) throw InputError(file.string(), "impacts", "none", "a result with a collision");
  return c;
}

double filmed_time(const StagedCollision& c) { return c.result.impacts.front().time; }

std::size_t body_named(const JsonField& json, const StagedCollision& c, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < c.shot.bodies.size(); ++i) {
    if (c.shot.bodies[i].name == name && c.shot.bodies[i].shape != Shape::fixed) return i;
    if (c.shot.bodies[i].shape != Shape::fixed) known += (known.empty() ? "" : " or ") + c.shot.bodies[i].name;
  }
  json.fail("a body that moves: " + known);
}

void read_swaps(StagedCollision& c, const JsonField& json, const fs::path& folder) {
  for (const JsonField& field : json.list()) {
    if (field.has("mass")) field["mass"].fail("none: the mass stays what it was");
    const Body body = read_body(field, folder);
    const std::size_t i = body_named(field["name"], c, body.name);
    if (body.shape == Shape::fixed) field["fixed"].fail("mesh, box or sphere");
    c.swaps[i] = body;
  }
}

/// An entry of the list, as often as it repeats. `timed` tells whether it says when.
void add_entry(StagePlan& plan, std::vector<char>& timed, const JsonField& json, const fs::path& folder) {
  json.allow_only({"name", "result", "shot", "time", "translate", "rotate_z_deg", "mass", "swap", "repeat", "every", "step"});
  const auto within = [&](const char* key) { return json.has(key) ? folder / json[key].text() : fs::path(); };
  (void)json["result"].text();
  StagedCollision c = read_collision(within("result"), within("shot"));
  if (json.has("name")) c.name = json["name"].text();
  if (c.name.empty() || c.name.find('.') != std::string::npos) json[json.has("name") ? "name" : "result"].fail("a name = \"…\" without a dot");
  if (json.has("time")) c.time = json["time"].number(0, kLongest);
  if (json.has("translate")) c.translate = json["translate"].vector();
  if (!(c.translate.norm() < kFarthest)) json["translate"].fail(fmt::format("at most {} m", kFarthest));
  if (json.has("rotate_z_deg")) c.turn = radians(json["rotate_z_deg"].number(-360, 360));
  if (json.has("mass")) c.mass = json["mass"].number(1e-6, kHeaviest);
  if (json.has("swap")) read_swaps(c, json["swap"], folder);
  const int repeats = json.has("repeat") ? json["repeat"].index(kMostRepeats + 1) : 1;
  if (repeats < 1) json["repeat"].fail("at least 1");
  const double every = json.has("every") ? json["every"].number(0, kLongest) : 0.0;
  const Vec3 step = json.has("step") ? json["step"].vector() : Vec3::Zero();
  if (repeats > 1 && every == 0 && step.isZero()) json["repeat"].fail("every (s) or step ([x, y, z], m) beside it: repeats cannot lie in one place at one time");
  if (every > 0 && !json.has("time")) json["every"].fail("time beside it: when the first one happens");
  for (int i = 0; i < repeats; ++i) {
    StagedCollision repeat = c;
    if (i > 0) repeat.name += fmt::format("-{}", i + 1);
    repeat.time += i * every;
    repeat.translate += i * step;
    for (const StagedCollision& other : plan.collisions)
      if (other.name == repeat.name) json[json.has("name") ? "name" : "result"].fail("a name = \"…\" of its own; \"" + repeat.name + "\" is taken");
    plan.collisions.push_back(std::move(repeat));
    timed.push_back(json.has("time"));
  }
}

/// Entries that do not say when collide when the one does that was filmed longest before its impact.
void set_times(StagePlan& plan, const std::vector<char>& timed) {
  double latest = 0;
  for (const StagedCollision& c : plan.collisions) latest = std::max(latest, filmed_time(c));
  for (std::size_t i = 0; i < plan.collisions.size(); ++i)
    if (!timed[i]) plan.collisions[i].time = latest;
}

/// What the shots have in common, and the time that they need.
void set_defaults(StagePlan& plan) {
  plan.gravity = plan.collisions.front().shot.gravity;
  plan.duration = 0;
  for (const StagedCollision& c : plan.collisions) {
    const double after = c.result.frames.empty() ? 0.0 : c.result.frames.back().time - filmed_time(c);
    plan.duration = std::max(plan.duration, c.time + std::max(after, 0.25));
  }
  for (const StagedMeeting& m : plan.meetings) plan.duration = std::max(plan.duration, m.time + kAfterMeeting);
}

StagedBody staged_body(const JsonField& json, const StagePlan& plan) {
  const std::string text = json.text();
  const std::size_t dot = text.find('.');
  std::string known;
  for (std::size_t i = 0; i < plan.collisions.size(); ++i) {
    if (dot != std::string::npos && plan.collisions[i].name == text.substr(0, dot))
      return {static_cast<int>(i), static_cast<int>(body_named(json, plan.collisions[i], text.substr(dot + 1)))};
    known += (i ? ", " : "") + plan.collisions[i].name;
  }
  json.fail("\"collision.body\"; the collisions are " + known);
}

StagedMeeting meeting(const JsonField& json, const StagePlan& plan) {
  json.allow_only({"bodies", "time", "restitution"});
  const auto bodies = json["bodies"].list();
  if (bodies.size() != 2) json["bodies"].fail("two, such as [\"one.ball\", \"two.box\"]");
  StagedMeeting m;
  m.bodies = {staged_body(bodies[0], plan), staged_body(bodies[1], plan)};
  m.time = json["time"].number(0, kLongest);
  if (json.has("restitution")) m.restitution = json["restitution"].number(0, 1);
  return m;
}

void check_gravity(const StagePlan& plan) {
  for (const StagedCollision& c : plan.collisions)
    if (c.shot.gravity != plan.gravity)
      throw InputError(plan.name, "gravity", fmt::format("{} of {} and {} of {}", plan.gravity, plan.collisions.front().name, c.shot.gravity, c.name),
                       "gravity = … (m/s²) in the shot list");
}

}  // namespace

StagePlan read_stage_list(const fs::path& path) {
  const nlohmann::json parsed = io::read_toml(path, "a shot list such as [[collision]] result = \"out\"");
  const JsonField json(parsed, path.string());
  json.allow_only({"fps", "duration", "gravity", "floor", "collision", "meet"});
  StagePlan plan;
  plan.name = path.string();
  std::vector<char> timed;
  for (const JsonField& field : json["collision"].list()) add_entry(plan, timed, field, path.parent_path());
  if (plan.collisions.empty()) json["collision"].fail("at least one");
  set_times(plan, timed);
  if (json.has("meet"))
    for (const JsonField& field : json["meet"].list()) plan.meetings.push_back(meeting(field, plan));
  set_defaults(plan);
  if (json.has("fps")) plan.fps = json["fps"].number(1, kMostFps);
  if (json.has("duration")) plan.duration = json["duration"].number(0.01, kLongest);
  if (json.has("floor")) plan.floor = json["floor"].number(-kFarthest, kFarthest);
  if (json.has("gravity"))
    plan.gravity = json["gravity"].number(0, kMostGravity);
  else
    check_gravity(plan);
  return plan;
}

StagePlan stage_side_by_side(const std::vector<std::string>& results) {
  StagePlan plan;
  plan.name = results.front();
  double edge = 0;
  for (const std::string& result : results) {
    StagedCollision c = read_collision(result, {});
    const auto taken = [&](const std::string& name) {
      return std::any_of(plan.collisions.begin(), plan.collisions.end(), [&](const StagedCollision& o) { return o.name == name; });
    };
    const auto alike = [&](const std::string& other) { return is_result(other) && folder_of(other).filename() == folder_of(result).filename(); };
    if (is_result(result) && std::count_if(results.begin(), results.end(), alike) > 1)  // each shot's folder has its "result"
      c.name = folder_of(result).parent_path().filename().string();
    const std::string name = c.name.empty() ? "collision" : c.name;
    c.name = name;
    for (int i = 2; taken(c.name); ++i) c.name = fmt::format("{}-{}", name, i);
    Eigen::AlignedBox3d reach;
    for (const FramePose& f : c.result.frames)
      for (const auto& body : f.bodies)
        if (body) reach.extend(body->p);
    reach.extend(c.result.impacts.front().contact_point);
    double margin = 0;
    for (const Body& body : c.shot.bodies) margin = std::max(margin, largest_extent(body));
    if (!plan.collisions.empty()) c.translate.x() = edge + margin - reach.min().x();
    edge = c.translate.x() + reach.max().x() + margin;
    plan.collisions.push_back(std::move(c));
  }
  set_times(plan, std::vector<char>(plan.collisions.size(), 0));
  set_defaults(plan);
  check_gravity(plan);
  return plan;
}

}  // namespace unseen::report
