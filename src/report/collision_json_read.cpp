// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_parts.h"
#include "unseen/report/collision_result.h"

namespace unseen::report {
namespace {

using namespace collision;

constexpr std::size_t kMost = 1'000'000'000;

Vec2 pair(const JsonField& json) {
  const auto values = json.list();
  if (values.size() != 2) json.fail("two numbers");
  return {values[0].number(), values[1].number()};
}

Estimate estimate(const JsonField& json) {
  const Estimate e = {json["value"].number(), json["sd"].number(0), json["low"].number(), json["high"].number()};
  if (e.low > e.high) json["low"].fail("at most high");
  return e;
}

std::optional<Estimate> estimate_or_null(const JsonField& json) {
  if (json.is_null()) return std::nullopt;
  return estimate(json);
}

BodyResult body(const JsonField& json) {
  BodyResult b;
  b.name = json["name"].text();
  if (json.has("fixed")) {
    if (!json["fixed"].truth()) json["fixed"].fail("true, or no such field");
    b.fixed = true;
    return b;
  }
  b.inertia = json["inertia"].vector();
  if (b.inertia.minCoeff() < 0.0) json["inertia"].fail("three numbers, none below 0");
  b.before = read_state(json["before"]);
  b.after = read_state(json["after"]);
  return b;
}

Impact impact(const JsonField& json, const std::vector<BodyResult>& bodies) {
  Impact i;
  i.time = json["time"].number();
  i.frame = json["frame"].number();
  i.restitution = estimate(json["restitution"]);
  i.tangential_restitution = read_number_or_null(json["tangential_restitution"]);
  i.friction = read_number_or_null(json["friction"]);
  i.impulse = json["impulse"].vector();
  i.contact_point = json["contact_point"].vector();
  i.normal = json["normal"].unit_vector();
  const auto names = json["between"].list();
  if (names.size() != 2) json["between"].fail("two names");
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string name = names[k].text();
    std::size_t b = 0;
    while (b < bodies.size() && bodies[b].name != name) ++b;
    if (b == bodies.size()) names[k].fail("the name of a body");
    i.between[k] = static_cast<int>(b);
  }
  return i;
}

FramePose frame(const JsonField& json, std::size_t bodies) {
  FramePose f;
  f.frame = json["frame"].index(kMost);
  f.time = json["t"].number();
  for (std::size_t b = 0; b < 2; ++b) {
    const std::string key = b == 0 ? "a" : "b";
    if (!json.has(key)) continue;
    if (b >= bodies) json[key].fail("a body of \"bodies\"");
    f.bodies[b] = BodyState{json[key]["p"].vector(), Vec3::Zero(), Vec3::Zero(), read_unit_quaternion(json[key]["q"])};
  }
  return f;
}

int body_key(const JsonField& json) {
  const std::string body = json.text();
  if (body != "a" && body != "b") json.fail("a or b");
  return body == "a" ? 0 : 1;
}

Sighted sighted(const JsonField& json) {
  const JsonField body = json["body"];
  return {json["frame"].index(kMost), body.is_null() ? std::nullopt : std::optional(body_key(body)), pair(json["center"]), json["diameter"].number(0.0)};
}

Residual residual(const JsonField& json) {
  return {json["frame"].index(kMost), body_key(json["body"]), pair(json["seen"]), pair(json["predicted"]), json["used"].truth()};
}

/// What stands for the whole shot must be what its first impact says.
void check_first_impact(const JsonField& json, const std::vector<Impact>& impacts) {
  for (const char* key : {"impulse", "contact_point", "normal", "collision_time"})
    if (json[key].is_null() != impacts.empty()) json[key].fail(impacts.empty() ? "null, for there is no impact" : "that of the first impact");
  if (impacts.empty()) return;
  const Impact& first = impacts.front();
  if (json["impulse"].vector() != first.impulse) json["impulse"].fail("that of the first impact");
  if (json["contact_point"].vector() != first.contact_point) json["contact_point"].fail("that of the first impact");
  if (json["normal"].vector() != first.normal) json["normal"].fail("that of the first impact");
  const JsonField time = json["collision_time"];
  if (time["time"].number() != first.time || time["frame"].number() != first.frame) time.fail("that of the first impact");
}

void read_solution(Reconstruction& r, const JsonField& json) {
  for (const JsonField& field : json["bodies"].list()) r.bodies.push_back(body(field));
  if (r.bodies.size() > 2) json["bodies"].fail("at most two");
  for (const JsonField& field : json["impacts"].list()) r.impacts.push_back(impact(field, r.bodies));
  check_first_impact(json, r.impacts);
  r.restitution = estimate_or_null(json["restitution"]);
  r.mass_ratio = estimate_or_null(json["mass_ratio"]);
  if (const JsonField fixed = json["fixed"]; !fixed.is_null()) r.fixed = fixed.text();
  for (const BodyResult& b : r.bodies)
    if (b.fixed && b.name != r.fixed) json["fixed"].fail(b.name);
  for (const JsonField& field : json["ambiguous"].list())
    r.ambiguous.push_back({field["what"].text(), field["restitution"].number(), r.fixed.empty() ? field["mass_ratio"].number() : 0.0,
                           field["excess"].number()});
  for (const JsonField& field : json["frames"].list()) r.frames.push_back(frame(field, r.bodies.size()));
  if (json.has("sighted"))
    for (const JsonField& field : json["sighted"].list()) {
      r.sighted.push_back(sighted(field));
      if (r.sighted.size() > 1 && r.sighted.back().frame < r.sighted[r.sighted.size() - 2].frame) field["frame"].fail("frames in order");
    }
  for (const JsonField& field : json["residuals"].list()) r.residuals.push_back(residual(field));
}

}  // namespace

Reconstruction parse_collision_result(const std::string& text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonField json(parsed, source);
  if (json["schema"].count() != 1) json["schema"].fail("1");
  if (json["capability"].text() != "collision") json["capability"].fail("\"collision\"");
  Reconstruction r;
  r.summary = read_summary(json["summary"], text);
  r.T_world_camera = read_transform(json["T_world_camera"]);
  r.camera = read_camera(json["camera"]);
  r.fps = json["fps"].number(0);
  r.gravity_direction = json["gravity_direction"].unit_vector();
  r.fits = json["fits"].truth();
  r.energy_before = json["energy"]["before"].number(0);
  r.energy_after = json["energy"]["after"].number(0);
  r.drag = read_number_or_null(json["drag"]);
  if (json.has("slowing")) r.slowing = json["slowing"].number(0);
  r.reprojection_rms = json["reprojection_rms"].number(0);
  r.held_out_rms = json["held_out_rms"].number(0);
  for (const JsonField& field : json["terms"].list())
    r.terms.push_back({field["name"].text(), field["residual"].number(0), field["weight"].number(0)});
  for (const JsonField& field : json["observability"].list()) r.observability.push_back(field.text());
  read_solution(r, json);
  return r;
}

Reconstruction read_collision_result(const std::filesystem::path& path) {
  return parse_collision_result(read_result_text(path), path.string());
}

}  // namespace unseen::report
