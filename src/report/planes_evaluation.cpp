// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_evaluation.h"

#include <fmt/format.h>

#include "report/json_write.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

Json angles_of(const planes::AngleScore& s) {
  return {{"pairs", s.pairs},
          {"mean_deg", number(degrees(s.mean))},
          {"median_deg", number(degrees(s.median))},
          {"deviation_deg", number(degrees(s.deviation))},
          {"below_0.1_deg", number(s.below_tenth)},
          {"below_1_deg", number(s.below_one)}};
}

Json score_of(const planes::AssignmentScore& s) {
  return {{"points_used", s.used},
          {"recalled", s.recalled},
          {"recall", number(s.recall)},
          {"angles", angles_of(s.angles)},
          {"angles_recalled", angles_of(s.angles_recalled)}};
}

std::string line(const std::string& name, const std::string& first, const std::string& second = "") {
  return fmt::format("{:<36}{:>14}", name, first) + (second.empty() ? "" : fmt::format("{:>16}", second)) +
         "\n";
}

std::string line(const std::string& name, std::size_t count) {
  return line(name, std::to_string(count));
}
std::string percent(double share) {
  return fmt::format("{:.2f} %", 100 * share);
}
std::string angle(double radians) {
  return fmt::format("{:.4f}°", degrees(radians));
}

std::string truth_lines(const planes::TruthScore& t) {
  const auto both = [&](const std::string& name, auto value) {
    return line(name, value(t.as_assigned), value(t.nearest));
  };
  using Score = planes::AssignmentScore;
  std::string text = line("points", t.points);
  text += line("  on a plane", t.assigned);
  text += line("  true normal ambiguous", t.ambiguous);
  text += line("  not covered by the truth", t.uncovered);
  text += line("", "as assigned", "nearest plane");
  for (const auto& [angles, of] : {std::pair{&Score::angles, ""}, {&Score::angles_recalled, ", recalled"}}) {
    const auto figure = [&, a = angles, of = std::string(of)](const std::string& name, auto value) {
      text += both(name + of, [&](const Score& s) { return value(s.*a); });
    };
    figure("angle error, mean", [](const planes::AngleScore& s) { return angle(s.mean); });
    figure("  median", [](const planes::AngleScore& s) { return angle(s.median); });
    figure("  standard deviation", [](const planes::AngleScore& s) { return angle(s.deviation); });
    figure("  pairs below 0.1°", [](const planes::AngleScore& s) { return percent(s.below_tenth); });
    figure("  pairs below 1°", [](const planes::AngleScore& s) { return percent(s.below_one); });
  }
  return text + both("recall", [](const Score& s) { return percent(s.recall); });
}

std::string label_lines(const planes::LabelScore& l) {
  return line("true regions", l.labels) + line("regions found", l.planes) + line("  correct", l.correct) +
         line("  over-segmented", l.over_segmented) + line("  under-segmented", l.under_segmented) +
         line("  missed", l.missed) + line("  noise", l.noise) + line("precision", percent(l.precision)) +
         line("recall", percent(l.recall)) + line("F1", percent(l.f1));
}

}  // namespace

std::string evaluation_json(const PlanesEvaluation& e) {
  const planes::RelationScore& r = e.relations;
  Json json = {{"unseen", kVersion},
               {"schema", 1},
               {"capability", "planes"},
               {"result", e.result_path},
               {"truth", {{"path", e.truth_path}, {"kind", e.truth_kind}}},
               {"scale", number(e.scale)},
               {"relations",
                {{"planes", r.planes},
                 {"directions", r.directions},
                 {"frames", r.frames},
                 {"relations", r.relations},
                 {"plane_relations", r.plane_relations},
                 {"largest_error_deg", number(degrees(r.largest_error))},
                 {"near_misses", r.near_misses}}}};
  if (e.truth)
    json["angles"] = {{"points", e.truth->points},
                      {"assigned", e.truth->assigned},
                      {"ambiguous", e.truth->ambiguous},
                      {"uncovered", e.truth->uncovered},
                      {"as_assigned", score_of(e.truth->as_assigned)},
                      {"nearest", score_of(e.truth->nearest)}};
  if (e.labels)
    json["segments"] = {{"planes", e.labels->planes},
                        {"labels", e.labels->labels},
                        {"correct", e.labels->correct},
                        {"over_segmented", e.labels->over_segmented},
                        {"under_segmented", e.labels->under_segmented},
                        {"missed", e.labels->missed},
                        {"noise", e.labels->noise},
                        {"precision", number(e.labels->precision)},
                        {"recall", number(e.labels->recall)},
                        {"f1", number(e.labels->f1)}};
  return text_of(json);
}

std::string evaluation_table(const PlanesEvaluation& e) {
  const planes::RelationScore& r = e.relations;
  std::string text;
  if (e.truth) text += truth_lines(*e.truth);
  if (e.labels) text += label_lines(*e.labels);
  text += line("planes", r.planes) + line("orientation frames", r.frames) + line("relations", r.relations) +
          line("related pairs of planes", r.plane_relations);
  text += line("largest error of a relation", fmt::format("{:.2g}°", degrees(r.largest_error)));
  return text + line("pairs 0.01° to 1° off a relation", r.near_misses);
}

}  // namespace unseen::report
