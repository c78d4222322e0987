// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/cuboids_evaluation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/json_write.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

Json graph_of(const cuboids::GraphScore& s) {
  return {{"edges", s.edges},           {"true_edges", s.true_edges},     {"correct", s.correct},
          {"precision", number(s.precision)}, {"recall", number(s.recall)}, {"f1", number(s.f1)}};
}

Json sizes_of(const cuboids::SizeScore& s) {
  return {{"dimensions", s.dimensions},
          {"fitted", number(s.fitted)},
          {"dropped", number(s.dropped)},
          {"fused", number(s.fused)},
          {"completed", number(s.completed)}};
}

template <class... Cells>
std::string line(const std::string& name, const Cells&... cells) {
  return fmt::format("{:<36}", name) + (fmt::format("{:>12}", cells) + ... + "\n");
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

std::string graph_line(const std::string& name, const cuboids::GraphScore& s) {
  return line(name, percent(s.precision), percent(s.recall), percent(s.f1));
}

std::string size_line(const std::string& name, const cuboids::SizeScore& s) {
  if (s.dimensions == 0) return "";
  return line(fmt::format("{} ({})", name, s.dimensions), percent(s.fitted), percent(s.dropped), percent(s.fused),
              percent(s.completed));
}

}  // namespace

std::string evaluation_json(const CuboidsEvaluation& e) {
  const cuboids::Evaluation& s = e.scores;
  Json json = {{"unseen", kVersion}, {"schema", 1}, {"capability", "cuboids"}, {"result", e.result_path}, {"cuboids", s.cuboids}};
  if (!e.truth_path.empty())
    json.update({{"truth", {{"path", e.truth_path}, {"family", e.family}}},
                 {"true_cuboids", s.true_cuboids},
                 {"found", s.found},
                 {"contacts", {{"before", graph_of(s.contacts_before)}, {"after", graph_of(s.contacts_after)}}},
                 {"sizes", {{"all", sizes_of(s.sizes)}, {"seen", sizes_of(s.seen_sizes)}, {"hidden", sizes_of(s.hidden_sizes)}}},
                 {"change",
                  {{"dimensions", s.change.dimensions},
                   {"error_before", number(s.change.before)},
                   {"error_after", number(s.change.after)},
                   {"change", number(s.change.change)}}}});
  if (s.pose)
    json["pose"] = {{"boxes", s.pose->boxes},
                    {"iou_before", number(s.pose->iou_before)},
                    {"iou_after", number(s.pose->iou_after)},
                    {"center", number(s.pose->center)},
                    {"angle_deg", degrees_of(s.pose->angle)}};
  if (s.hidden_part)
    json["hidden_part"] = {{"extension", number(s.hidden_part->extension)},
                           {"hidden", number(s.hidden_part->hidden)},
                           {"iou", number(s.hidden_part->iou)}};
  if (s.referee)
    json["referee"] = {{"bodies", s.referee->bodies},
                       {"still", s.referee->still},
                       {"share", number(s.referee->share)},
                       {"farthest", number(s.referee->farthest)},
                       {"moved", s.referee->moved}};
  return text_of(json);
}

std::string evaluation_table(const CuboidsEvaluation& e) {
  const cuboids::Evaluation& s = e.scores;
  std::string text;
  if (!e.truth_path.empty()) text += line("true boxes", s.true_cuboids) + line("  found", s.found);
  text += line("boxes of the result", s.cuboids);
  if (!e.truth_path.empty()) {
    text += line("contacts", "precision", "recall", "F1");
    text += graph_line("  initial boxes", s.contacts_before) + graph_line("  result", s.contacts_after);
    text += line("sizes right", "as fitted", "dropped", "fused", "result");
    text += size_line("  all", s.sizes) + size_line("  seen", s.seen_sizes) + size_line("  hidden", s.hidden_sizes);
  }
  if (s.change.dimensions > 0)
    text += line("error of the sizes that moved", percent(s.change.before), "to", percent(s.change.after));
  if (s.pose) {
    text += line("overlap with the true boxes", percent(s.pose->iou_before), "to", percent(s.pose->iou_after));
    text += line("centres off by", fmt::format("{:.1f} mm", 1000 * s.pose->center)) +
            line("turned by", fmt::format("{:.2f}°", degrees(s.pose->angle)));
  }
  if (s.hidden_part) text += line("overlap with the hidden part", percent(s.hidden_part->iou));
  if (s.referee)
    text += line("stand still in MuJoCo", fmt::format("{} of {}", s.referee->still, s.referee->bodies), percent(s.referee->share));
  if (s.referee && !s.referee->moved.empty()) text += fmt::format("  do not: box {}\n", fmt::join(s.referee->moved, ", "));
  return text;
}

}  // namespace unseen::report
