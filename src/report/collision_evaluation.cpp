// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/collision_evaluation.h"

#include <fmt/format.h>

#include "report/json_write.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

Json score_of(const std::optional<collision::ValueScore>& s) {
  if (!s) return nullptr;
  return {{"value", number(s->value)}, {"truth", number(s->truth)}, {"error", number(s->error)}, {"covered", s->covered}};
}

Json score_of(const collision::MotionScore& m) {
  Json json = {{"name", m.name}, {"frames", m.frames}, {"trajectory", number(m.trajectory)}, {"depth", number(m.depth)}, {"across", number(m.across)}};
  json["rotation_deg"] = m.rotation ? degrees_of(*m.rotation) : Json(nullptr);
  return json;
}

template <class... Cells>
std::string line(const std::string& name, const Cells&... cells) {
  return fmt::format("{:<28}", name) + (fmt::format("{:>14}", cells) + ... + "\n");
}

std::string value_line(const std::string& name, const std::optional<collision::ValueScore>& s, bool relative) {
  if (!s) return line(name, "no value");
  return line(name, fmt::format("{:.4f}", s->value), fmt::format("{:.4f}", s->truth), relative ? fmt::format("{:.2f} %", 100 * s->error) : fmt::format("{:.4f}", s->error),
              s->covered ? "yes" : "no");
}

}  // namespace

std::string evaluation_json(const CollisionEvaluation& e) {
  const collision::Evaluation& s = e.scores;
  Json json = {{"unseen", kVersion},
               {"schema", 1},
               {"capability", "collision"},
               {"result", e.result_path},
               {"truth", {{"path", e.truth_path}, {"scene", e.scene}}},
               {"impacts", s.impacts},
               {"true_impacts", s.true_impacts},
               {"found", s.found},
               {"restitution", score_of(s.restitution)},
               {"mass_ratio", score_of(s.mass_ratio)},
               {"motions", list_of(s.motions, [](const auto& m, std::size_t) { return score_of(m); })}};
  json["time_frames"] = s.time ? number(*s.time) : Json(nullptr);
  json["penetration"] = s.penetration ? number(*s.penetration) : Json(nullptr);
  json["gravity_deg"] = degrees_of(s.gravity);
  return text_of(json);
}

std::string evaluation_table(const CollisionEvaluation& e) {
  const collision::Evaluation& s = e.scores;
  std::string text = line("impacts", fmt::format("{} of {}", s.found, s.true_impacts), fmt::format("{} in result", s.impacts));
  text += line("", "value", "truth", "error", "in interval") + value_line("restitution", s.restitution, false) + value_line("mass ratio", s.mass_ratio, true);
  text += line("motion", "frames", "path", "across view", "turned by");
  for (const collision::MotionScore& m : s.motions)
    text += line("  " + m.name, m.frames, fmt::format("{:.2f} %", 100 * m.trajectory), fmt::format("{:.2f} %", 100 * m.across),
                 m.rotation ? fmt::format("{:.2f}°", degrees(*m.rotation)) : "–");
  if (s.time) text += line("time of the impact off by", fmt::format("{:.3f} frames", *s.time));
  if (s.penetration) text += line("penetration at the impact", fmt::format("{:.2f} mm", 1000 * *s.penetration));
  return text + line("vertical off by", fmt::format("{:.2f}°", degrees(s.gravity)));
}

}  // namespace unseen::report
