// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/interactions_evaluation.h"

#include <fmt/format.h>

#include "report/json_write.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr const char* kTold[] = {"sit", "stand up", "walk", "reach"};

Json or_null(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
Json id_or_null(int id) { return id >= 0 ? Json(id) : Json(nullptr); }

Json object_of(const ObjectScore& s) {
  return {{"truth", id_or_null(s.truth)},
          {"found", id_or_null(s.found)},
          {"category", s.category},
          {"superclass", kSuperclasses[static_cast<int>(s.superclass)]},
          {"interacted", s.interacted},
          {"distance", or_null(s.distance)}};
}

Json pose_of(const std::optional<PoseScore>& s) {
  if (!s) return nullptr;
  return {{"frames", s->frames}, {"interpolated", s->interpolated}, {"local", number(s->local)}, {"world", number(s->world)}};
}

template <class... Cells>
std::string line(const std::string& name, const Cells&... cells) {
  return fmt::format("{:<34}", name) + (fmt::format("{:>12}", cells) + ... + "\n");
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }
std::string centimetres(const std::optional<double>& metres) { return metres ? fmt::format("{:.1f} cm", 100 * *metres) : "–"; }

std::string object_line(const ObjectScore& s) {
  if (s.truth < 0) return line(fmt::format("  {} (found {})", s.category, s.found), "false");
  const std::string name = fmt::format("  {} {}", s.category, s.truth);
  if (s.found < 0) return s.interacted ? line(name, "not found") : "";
  return line(name + fmt::format(" (found {})", s.found), centimetres(s.distance), s.interacted ? "" : "unused");
}

std::string pose_line(const std::string& name, const std::optional<PoseScore>& s) {
  if (!s) return line(name, "–");
  std::string frames = fmt::format("{} frames", s->frames);
  return line(name, centimetres(s->local), fmt::format("{:.3f}", s->world), frames) +
         (s->interpolated > 0 ? line("  between frames of the result", "", "", fmt::format("{} frames", s->interpolated)) : "");
}

}  // namespace

std::string evaluation_json(const InteractionsEvaluation& e) {
  const Evaluation& s = e.scores;
  const Json json = {{"unseen", kVersion},
                     {"schema", 1},
                     {"capability", "interactions"},
                     {"result", e.result_path},
                     {"truth", {{"path", e.truth_path}, {"scene", e.scene}}},
                     {"interacted", s.interacted},
                     {"found", s.found},
                     {"false_objects", s.false_objects},
                     {"distance", {{"mean", or_null(s.mean_distance)}, {"sd", or_null(s.sd_distance)}, {"median", or_null(s.median_distance)}}},
                     {"objects", list_of(s.objects, [](const ObjectScore& o, std::size_t) { return object_of(o); })},
                     {"poses", {{"occluded", pose_of(s.occluded)}, {"all", pose_of(s.all)}}},
                     {"actions", {{"accuracy", number(s.action_accuracy)}, {"names", kTold}, {"confusion", s.confusion}}},
                     {"inside_objects", number(s.inside_objects)},
                     {"true_inside_objects", number(s.true_inside_objects)},
                     {"foot_skating", number(s.foot_skating)},
                     {"overlapping", number(s.overlapping)},
                     {"identity", or_null(s.identity)}};
  return text_of(json);
}

std::string evaluation_table(const InteractionsEvaluation& e) {
  const Evaluation& s = e.scores;
  std::string text = line("interacted objects found", fmt::format("{} of {}", s.found, s.interacted)) + line("false objects", s.false_objects);
  text += line("distance", "mean", "SD", "median") + line("", centimetres(s.mean_distance), centimetres(s.sd_distance), centimetres(s.median_distance));
  for (const ObjectScore& o : s.objects) text += object_line(o);
  text += line("poses", "local", "world", "") + pose_line("  occluded joints", s.occluded) + pose_line("  all joints", s.all);
  text += line("actions right", percent(s.action_accuracy)) + line("  true \\ found", "sit", "stand up", "walk", "reach");
  for (std::size_t r = 0; r < s.confusion.size(); ++r) {
    text += fmt::format("{:<34}", fmt::format("  {}", kTold[r]));
    for (const int frames : s.confusion[r]) text += fmt::format("{:>12}", frames);
    text += "\n";
  }
  text += line("frames inside an object", percent(s.inside_objects), fmt::format("truth {:.1f} %", 100 * s.true_inside_objects));
  text += line("foot skating", fmt::format("{:.2f} m/s", s.foot_skating)) + line("objects overlap", fmt::format("{:.3f} m²", s.overlapping));
  if (s.identity) text += line("people told apart", percent(*s.identity));
  return text;
}

}  // namespace unseen::report
