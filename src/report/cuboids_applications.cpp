// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/cuboids_applications.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/json_field.h"
#include "report/json_write.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using io::JsonField;

constexpr double kFarthest = 100.0;  // m
constexpr std::size_t kMostEdits = 1000, kLargestId = 1'000'000;

void refuse_unknown(const JsonField& object, const std::vector<std::string>& known) {
  for (const auto& [key, field] : object.members())
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string names;
      for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
      field.fail("one of the keys " + names);
    }
}

cuboids::PhotoEdit edit_of(const JsonField& field) {
  refuse_unknown(field, {"id", "remove", "move", "turn_deg"});
  cuboids::PhotoEdit edit;
  edit.id = field["id"].index(kLargestId);
  const bool moves = field.has("move") || field.has("turn_deg");
  if (field.has("remove")) {
    const auto remove = field["remove"].option();
    if (!remove || !std::holds_alternative<bool>(*remove)) field["remove"].fail("true or false");
    edit.remove = std::get<bool>(*remove);
  }
  if (edit.remove == moves) field.fail(moves ? "either remove or move, not both" : "remove, or move and turn_deg");
  if (field.has("move")) {
    edit.move = field["move"].vector();
    if (edit.move.cwiseAbs().maxCoeff() > kFarthest) field["move"].fail("at most 100 m a coordinate");
  }
  if (field.has("turn_deg")) edit.turn = radians(field["turn_deg"].number(-360.0, 360.0));
  return edit;
}

}  // namespace

std::vector<cuboids::PhotoEdit> parse_photo_edits(const std::string& text, const std::string& source) {
  const nlohmann::json json = io::parse_json(text, source, "edits of a photograph");
  const JsonField root(json, source);
  refuse_unknown(root, {"edits"});
  const std::vector<JsonField> list = root["edits"].list();
  if (list.empty() || list.size() > kMostEdits) root["edits"].fail("1 to 1000 edits");
  std::vector<cuboids::PhotoEdit> edits;
  for (const JsonField& field : list) {
    edits.push_back(edit_of(field));
    for (std::size_t i = 0; i + 1 < edits.size(); ++i)
      if (edits[i].id == edits.back().id) field["id"].fail("one edit for each cuboid");
  }
  return edits;
}

std::string scan_completion_json(const cuboids::ScanCompletion& completion, const std::string& model) {
  Json json = {{"model", model}, {"found", completion.found}, {"T_world_model", matrix_of(completion.T_world_model)}};
  json["matches"] = Json::array();
  for (const cuboids::BoxMatch& match : completion.matches)
    json["matches"].push_back({{"model_box", match.model_box}, {"cuboid", match.cuboid}});
  json["model_boxes"] = Json::array();
  for (const OrientedBox& box : completion.model_boxes) {
    Json axes = Json::array();
    for (int k = 0; k < 3; ++k) axes.push_back(vector_of(box.axes.col(k)));
    json["model_boxes"].push_back({{"center", vector_of(box.center)}, {"axes", axes}, {"size", vector_of(2.0 * box.half_size)}});
  }
  json["rms"] = number(completion.rms);
  json["explained"] = number(completion.explained);
  return text_of(json);
}

std::string retrieval_json(const cuboids::Retrieval& retrieval, const std::vector<cuboids::RetrievalModel>& models) {
  Json json = {{"cuboids", retrieval.ids}};
  json["models"] = Json::array();
  for (const cuboids::RetrievedModel& found : retrieval.ranked)
    json["models"].push_back({{"model", models.at(static_cast<std::size_t>(found.model)).name},
                              {"score", number(found.score)},
                              {"structure_share", number(found.structure_share)},
                              {"model_share", number(found.model_share)},
                              {"scale", number(found.scale)},
                              {"T_world_model", matrix_of(found.T_world_model, found.scale)}});
  return text_of(json);
}

std::string mesh_ply(const TriangleMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  auto out = std::back_inserter(text);
  for (const Vec3& v : mesh.vertices) fmt::format_to(out, "{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) fmt::format_to(out, "3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace unseen::report
