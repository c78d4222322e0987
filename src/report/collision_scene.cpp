// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/collision_scene.h"

#include <fmt/format.h>

#include <filesystem>

#include "report/collision_motion.h"
#include "report/collision_structures.h"

namespace unseen::report {
namespace {

using namespace collision;

Json or_null(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

int digits_of(const Estimate& e) { return e.sd >= 0.001 ? 3 : 4; }

/// "0.760 ± 0.004", with one standard deviation where that does not end beyond the interval.
std::string value_text(const Estimate& e) {
  const bool even = e.low <= e.value - e.sd && e.value + e.sd <= e.high;
  return even ? fmt::format("{:.{}f} ± {:.{}f}", e.value, digits_of(e), e.sd, digits_of(e)) : fmt::format("{:.{}f}", e.value, digits_of(e));
}

/// "0.752…0.767"
std::string interval_text(const Estimate& e) { return fmt::format("{:.{}f}…{:.{}f}", e.low, digits_of(e), e.high, digits_of(e)); }

Json row_of(std::string_view name, const Estimate& e) { return {name, number(e.value), interval_text(e), number(e.sd)}; }

void add_value_table(SceneBuilder& scene, const Reconstruction& r) {
  Json rows = Json::array();
  if (r.restitution) rows.push_back(row_of("restitution", *r.restitution));
  if (r.mass_ratio) rows.push_back(row_of(fmt::format("mass, {} : {}", name_of(r, 1), name_of(r, 0)), *r.mass_ratio));
  if (r.restitution) {
    const auto energy = [&](const char* when, double value) { rows.push_back({fmt::format("energy {}, J/kg", when), number(value), nullptr, nullptr}); };
    energy("before", r.energy_before);
    energy("after", r.energy_after);
  }
  add_table(scene, "Values", {column("value of"), column("value", "", 4), column("95 %"), column("sd", "", 4)}, std::move(rows));
}

void add_impact_table(SceneBuilder& scene, const Reconstruction& r) {
  if (!r.fits) {  // what the solver ended with says when, and nothing else
    Json rows = Json::array();
    for (const Impact& i : r.impacts) rows.push_back({number(i.frame), number(i.time)});
    add_table(scene, "Impacts looked for: the model does not fit", {column("frame", "", 2), column("time", "s", 4)}, std::move(rows));
    return;
  }
  Json rows = Json::array();
  for (const Impact& i : r.impacts)
    rows.push_back({number(i.frame), number(i.time), number(i.restitution.value), interval_text(i.restitution),
                    or_null(i.tangential_restitution), or_null(i.friction), number(i.impulse.norm())});
  add_table(scene, "Impacts",
            {column("frame", "", 2), column("time", "s", 4), column("restitution", "", 3), column("95 %"),
             column("tangential", "", 3), column("friction", "", 3), column("impulse", "m/s", 3)},
            std::move(rows));
}

void add_body_table(SceneBuilder& scene, const Reconstruction& r) {
  if (r.impacts.empty() || !r.fits) return;
  Json rows = Json::array();
  for (const BodyResult& b : r.bodies) {
    if (b.fixed) continue;
    for (const auto& [when, state] : {std::pair("before", &b.before), std::pair("after", &b.after)})
      rows.push_back({b.name, when, number(state->v.norm()), fmt::format("{:.2f}, {:.2f}, {:.2f}", state->v.x(), state->v.y(), state->v.z()), number(state->k.norm())});
  }
  add_table(scene, "Bodies at the impact",
            {column("body"), column("when"), column("speed", "m/s", 3), column("velocity", "m/s"), column("angular momentum", "m²/s", 5)}, std::move(rows));
}

void add_evidence_tables(SceneBuilder& scene, const Reconstruction& r) {
  Json alternatives = Json::array(), terms = Json::array(), weak = Json::array();
  for (const Alternative& a : r.ambiguous) alternatives.push_back({a.what, number(a.restitution), r.fixed.empty() ? number(a.mass_ratio) : Json(nullptr), number(a.excess)});
  for (const Term& t : r.terms) terms.push_back({t.name, number(t.residual), number(t.weight)});
  for (const std::string& text : r.observability) weak.push_back({text});
  add_table(scene, "Ambiguous: also explained by", {column("what"), column("restitution", "", 3), column("mass ratio", "", 3), column("larger χ² by", "", 1)},
            std::move(alternatives));
  add_table(scene, "Evidence", {column("term"), column("residual", "σ", 2), column("weight")}, std::move(terms));
  add_table(scene, "What the clip tells", {column("remark")}, std::move(weak));
}

void add_estimate(SceneBuilder& scene, std::string_view name, const std::optional<Estimate>& e, std::string_view help) {
  add_fact(scene, name, e ? value_text(*e) : "no confident value", help);
  if (e) add_fact(scene, fmt::format("{}, 95 %", name), interval_text(*e));
}

void add_facts(SceneBuilder& scene, const Reconstruction& r) {
  add_estimate(scene, "restitution", r.restitution, "Speed at which the bodies part, of the speed at which they meet. ± is one standard deviation");
  if (r.fixed.empty() && r.bodies.size() == 2) add_estimate(scene, fmt::format("mass, {} : {}", name_of(r, 1), name_of(r, 0)), r.mass_ratio, "");
  if (!r.frames.empty()) add_fact(scene, "the model fits", r.fits ? "yes" : "no", "Whether free flight, one impact after the other, explains what is seen within its noise");
  if (!r.ambiguous.empty()) add_fact(scene, "ambiguous", fmt::format("{} other solution{}", r.ambiguous.size(), r.ambiguous.size() == 1 ? "" : "s"), "They fit almost as well: see the table");
  add_fact(scene, r.fits ? "impacts" : "impacts looked for", std::to_string(r.impacts.size()));
  if (!r.impacts.empty() && r.fits) add_fact(scene, "first impact, frame", fmt::format("{:.2f}", r.impacts.front().frame));
  if (r.restitution) add_fact(scene, "kinetic energy kept", fmt::format("{:.0f} %", 100.0 * r.energy_after / r.energy_before));
  if (r.reprojection_rms > 0) add_fact(scene, "reprojection", fmt::format("{:.2f} px", r.reprojection_rms), "How far the solved paths are from what was tracked");
  if (r.held_out_rms > 0) add_fact(scene, "held-out frames", fmt::format("{:.2f} px", r.held_out_rms), "The same in frames that the solution was not shown");
  if (r.drag) add_fact(scene, "drag", fmt::format("{:.4g} 1/m", *r.drag), "Deceleration by air, of the speed squared");
  if (r.slowing) add_fact(scene, "slowed by", fmt::format("{:.3f} m/s²", *r.slowing), "Friction of what the bodies slide on, estimated");
}

/// What flies, not the camera that saw it from afar.
std::optional<Json> focus_of(const Reconstruction& r) {
  Eigen::AlignedBox3d reach;
  for (const FramePose& f : r.frames)
    for (const auto& body : f.bodies)
      if (body) reach.extend(body->p);
  if (reach.isEmpty()) return std::nullopt;
  const Vec3 margin = Vec3::Constant(std::max(0.05, 0.15 * reach.sizes().maxCoeff()));
  return Json({{"low", vector_of(reach.min() - margin)}, {"high", vector_of(reach.max() + margin)}});
}

}  // namespace

std::string estimate_text(const Estimate& e) {
  return fmt::format("{} (95 %: {})", value_text(e), interval_text(e));
}

std::string collision_scene(const Reconstruction& r, const InputRecord& input, const OptionTable& options, const std::string& command,
                            const Shot& shot, const std::vector<OverlayPicture>& pictures) {
  SceneBuilder scene(Vec3::Zero());
  Json& header = scene.header;
  header["title"] = collision_title(input);
  write_run(scene, "collision", command, r.summary, options, input);
  if (!r.restitution) header["verdict"] = r.impacts.empty() ? "no collision was found" : "no value of the restitution can be relied on";
  header["inside"] = false;
  if (const auto focus = focus_of(r)) header["focus"] = *focus;
  header["about"] =
      "Flights before and after each impact, as gravity and the laws of impact allow them for what the clip shows. 95 % intervals count on the sizes and the camera that "
      "were given; where the clip does not tell, no value is stated.";
  add_facts(scene, r);
  add_bodies(scene, shot, r);
  add_fixed(scene, shot, r);
  add_flights(scene, r, shot.gravity);
  add_impacts(scene, r);
  add_clip(scene, r, pictures);
  add_residual_chart(scene, r);
  add_value_table(scene, r);
  add_impact_table(scene, r);
  add_body_table(scene, r);
  add_evidence_tables(scene, r);
  return scene.encode();
}

std::string collision_title(const InputRecord& input) {
  const std::string name = std::filesystem::path(input.path).filename().string();
  return "Collision of " + (name.empty() ? input.path : name);
}

}  // namespace unseen::report
