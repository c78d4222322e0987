// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_parts.h"
#include "unseen/report/collision_result.h"

namespace unseen::report {
namespace {

using namespace collision;

Json pair_of(const Vec2& v) { return Json::array({number(v.x()), number(v.y())}); }

Json estimate_of(const Estimate& e) {
  return {{"value", number(e.value)}, {"sd", number(e.sd)}, {"low", number(e.low)}, {"high", number(e.high)}};
}

Json body_of(const BodyResult& b) {
  if (b.fixed) return {{"name", b.name}, {"fixed", true}};
  return {{"name", b.name}, {"inertia", vector_of(b.inertia)}, {"before", state_of(b.before)}, {"after", state_of(b.after)}};
}

Json frame_of(const FramePose& f) {
  Json json = {{"frame", f.frame}, {"t", number(f.time)}};
  for (int b = 0; b < 2; ++b)
    if (f.bodies[b]) json[kBodyKeys[b]] = {{"p", vector_of(f.bodies[b]->p)}, {"q", quaternion_of(f.bodies[b]->q)}};
  return json;
}

Json residual_of(const Residual& r) {
  return {{"frame", r.frame}, {"body", kBodyKeys[r.body]}, {"seen", pair_of(r.seen)}, {"predicted", pair_of(r.predicted)}, {"used", r.used}};
}

Json sighted_of(const Sighted& s) {
  return {{"frame", s.frame}, {"body", s.body ? Json(kBodyKeys[*s.body]) : Json(nullptr)}, {"center", pair_of(s.center)}, {"diameter", number(s.diameter)}};
}

/// The shot's impulse, contact point, normal and time are those of its first impact.
void write_first_impact(Json& json, const std::vector<Impact>& impacts) {
  if (impacts.empty()) {
    for (const char* key : {"impulse", "contact_point", "normal", "collision_time"}) json[key] = nullptr;
    return;
  }
  const Impact& first = impacts.front();
  json["impulse"] = vector_of(first.impulse);
  json["contact_point"] = vector_of(first.contact_point);
  json["normal"] = vector_of(first.normal);
  json["collision_time"] = {{"time", number(first.time)}, {"frame", number(first.frame)}};
}

}  // namespace

std::string collision_json(const Reconstruction& r, const InputRecord& input, const OptionTable& options) {
  Json json = result_header("collision", input, options, r.summary);
  json["T_world_camera"] = matrix_of(r.T_world_camera);
  json["camera"] = camera_of(r.camera);
  json["fps"] = number(r.fps);
  json["impacts"] = list_of(r.impacts, [&](const Impact& i, std::size_t) { return impact_of(i, estimate_of(i.restitution), {r.bodies.at(0).name, r.bodies.at(1).name}); });
  json["restitution"] = or_null(r.restitution, estimate_of);
  json["mass_ratio"] = or_null(r.mass_ratio, estimate_of);
  json["fixed"] = r.fixed.empty() ? Json(nullptr) : Json(r.fixed);
  json["fits"] = r.fits;
  json["ambiguous"] = list_of(r.ambiguous, [&](const Alternative& a, std::size_t) -> Json {
    const Json mass_ratio = r.fixed.empty() ? number(a.mass_ratio) : Json(nullptr);
    return {{"what", a.what}, {"restitution", number(a.restitution)}, {"mass_ratio", mass_ratio}, {"excess", number(a.excess)}};
  });
  write_first_impact(json, r.impacts);
  json["gravity_direction"] = vector_of(r.gravity_direction);
  json["bodies"] = list_of(r.bodies, [](const BodyResult& b, std::size_t) { return body_of(b); });
  json["energy"] = {{"before", number(r.energy_before)}, {"after", number(r.energy_after)}};
  json["drag"] = or_null(r.drag, number);
  if (r.slowing) json["slowing"] = number(*r.slowing);
  json["terms"] = list_of(r.terms, [](const Term& t, std::size_t) -> Json {
    return {{"name", t.name}, {"residual", number(t.residual)}, {"weight", number(t.weight)}};
  });
  json["observability"] = r.observability;
  json["reprojection_rms"] = number(r.reprojection_rms);
  json["held_out_rms"] = number(r.held_out_rms);
  json["frames"] = list_of(r.frames, [](const FramePose& f, std::size_t) { return frame_of(f); });
  if (!r.sighted.empty()) json["sighted"] = list_of(r.sighted, [](const Sighted& s, std::size_t) { return sighted_of(s); });
  json["residuals"] = list_of(r.residuals, [](const Residual& x, std::size_t) { return residual_of(x); });
  return text_of(json);
}

}  // namespace unseen::report
