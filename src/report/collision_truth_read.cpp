// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "report/collision_parts.h"
#include "report/collision_shot_parts.h"
#include "unseen/report/collision_truth.h"

namespace unseen::report {
namespace {

using namespace collision;

constexpr std::size_t kLastTrueFrame = 1'000'000'000;

/// {"value", "sd": 0}, as a result's estimates have it.
std::optional<double> exact(const JsonField& json, double most) {
  if (json.is_null()) return std::nullopt;
  json.allow_only({"value", "sd"});
  if (json["sd"].number() != 0) json["sd"].fail("0, for this is the truth");
  return json["value"].number(0, most);
}

int body_named(const JsonField& name, const std::vector<Body>& bodies) {
  const std::string text = name.text();
  const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == text; });
  if (found == bodies.end()) name.fail("the name of a body");
  return static_cast<int>(found - bodies.begin());
}

Impact read_impact(const JsonField& json, const Truth& truth) {
  Impact i;
  i.time = json["time"].number();
  i.frame = json["frame"].number();
  const auto restitution = exact(json["restitution"], 1);
  if (!restitution) json["restitution"].fail("a value");
  i.restitution.value = *restitution;
  i.tangential_restitution = read_number_or_null(json["tangential_restitution"]);
  i.friction = read_number_or_null(json["friction"]);
  i.impulse = json["impulse"].vector();
  i.contact_point = json["contact_point"].vector();
  i.normal = json["normal"].unit_vector();
  const auto names = json["between"].list();
  if (names.size() != 2) json["between"].fail("two names");
  for (std::size_t k = 0; k < 2; ++k) i.between[k] = body_named(names[k], truth.bodies);
  if (i.between[0] == i.between[1]) json["between"].fail("two different bodies");
  return i;
}

FramePose read_frame(const JsonField& json, const Truth& truth) {
  FramePose f;
  f.frame = json["frame"].index(kLastTrueFrame);
  if (!truth.frames.empty() && f.frame <= truth.frames.back().frame) json["frame"].fail("frames in their order");
  f.time = json["t"].number(0);
  for (std::size_t b = 0; b < 2; ++b) {
    if (!json.has(kBodyKeys[b])) continue;
    const JsonField state = json[kBodyKeys[b]];
    if (b >= truth.bodies.size() || truth.bodies[b].shape == Shape::fixed) state.fail("nothing, for there is no such body that moves");
    f.bodies[b] = read_state(state);
  }
  return f;
}

}  // namespace

Truth read_collision_truth(const std::filesystem::path& path) {
  const nlohmann::json parsed = parse_json(read_result_text(path), path.string());
  const JsonField json(parsed, path.string());
  if (json["capability"].text() != "synth collision") json["capability"].fail("\"synth collision\"");
  Truth truth;
  truth.scene = json["scene"].text();
  truth.T_world_camera = read_transform(json["T_world_camera"]);
  truth.camera = read_camera(json["camera"]);
  truth.fps = json["fps"].number(0);
  if (!(truth.fps > 0)) json["fps"].fail("a number above 0");
  const auto bodies = json["bodies"].list();
  if (bodies.size() != 2) json["bodies"].fail("two bodies");
  for (const JsonField& field : bodies) truth.bodies.push_back(read_body(field, path.parent_path()));
  for (const JsonField& field : json["impacts"].list()) truth.impacts.push_back(read_impact(field, truth));
  truth.restitution = exact(json["restitution"], 1);
  truth.mass_ratio = exact(json["mass_ratio"], 1e6);
  for (const JsonField& field : json["frames"].list()) truth.frames.push_back(read_frame(field, truth));
  return truth;
}

}  // namespace unseen::report
