// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "report/json_write.h"
#include "unseen/report/interactions_result.h"

namespace unseen::report {
namespace {

using namespace interactions;

Json numbers_of(const double* values, Eigen::Index count) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < count; ++i) list.push_back(number(values[i]));
  return list;
}

Json part_of(const Part& p) {
  return {{"name", p.name}, {"center", vector_of(p.box.center)}, {"size", vector_of(2.0 * p.box.half_size)}, {"axes", axes_of(p.box.axes)}};
}

Json object_of(const FoundObject& f) {
  const OrientedBox box = upright_box(f.object);
  return {{"id", f.object.id},
          {"category", f.object.category},
          {"superclass", kSuperclasses[static_cast<int>(f.object.superclass())]},
          {"confidence", number(f.confidence)},
          {"center", vector_of(box.center)},
          {"size", vector_of(2.0 * box.half_size)},
          {"yaw", number(std::atan2(box.axes(1, 0), box.axes(0, 0)))},
          {"parts", list_of(f.object.parts, [](const Part& p, std::size_t) { return part_of(p); })},
          {"windows", f.windows}};
}

Json frame_of(const PersonFrame& f) {
  Json joints = Json::array();
  for (int j = 0; j < kJoints; ++j) joints.push_back(vector_of(f.pose.col(j)));
  return {{"frame", f.frame},
          {"joints", joints},
          {"source", kPoseSources[static_cast<int>(f.source)]},
          {"action", kActions[static_cast<int>(f.action)]},
          {"confidence", numbers_of(f.confidence.data(), kJoints)}};
}

Json person_of(const Person& p) {
  return {{"id", p.id},
          {"frames", list_of(p.frames, [](const PersonFrame& f, std::size_t) { return frame_of(f); })},
          {"likelihood", numbers_of(p.likelihood.data(), static_cast<Eigen::Index>(p.likelihood.size()))}};
}

Json window_of(const Window& w) {
  return {{"person", w.person},
          {"first", w.first},
          {"last", w.last},
          {"scenelet", w.scenelet},
          {"likelihood", number(w.likelihood)},
          {"energy", number(w.energy)},
          {"position", vector_of(w.placement.position)},
          {"yaw", number(w.placement.angle)}};
}

}  // namespace

OrientedBox upright_box(const Object& object) {
  OrientedBox around;
  if (object.parts.empty()) return around;
  const auto main = std::find_if(object.parts.begin(), object.parts.end(), is_main);
  const OrientedBox& like = (main == object.parts.end() ? object.parts.front() : *main).box;
  const Vec3 x = like.axes.col(0);
  around.axes = Eigen::AngleAxisd(std::atan2(x.y(), x.x()), Vec3::UnitZ()).toRotationMatrix();
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (const Part& part : object.parts) {
    const Vec3 center = around.axes.transpose() * part.box.center;
    const Vec3 half = (around.axes.transpose() * part.box.axes).cwiseAbs() * part.box.half_size;
    low = low.cwiseMin(center - half);
    high = high.cwiseMax(center + half);
  }
  around.center = around.axes * (0.5 * (low + high));
  around.half_size = 0.5 * (high - low);
  return around;
}

std::string interactions_json(const Reconstruction& r, const InputRecord& input, const OptionTable& options) {
  Json json = result_header("interactions", input, options, r.summary);
  json["T_world_camera"] = matrix_of(r.T_world_camera);
  json["camera"] = camera_of(r.camera);
  json["fps"] = number(r.fps);
  json["ground"] = {{"camera_height", number(r.ground.camera_height)},
                    {"pitch_deg", degrees_of(r.ground.pitch)},
                    {"roll_deg", degrees_of(r.ground.roll)},
                    {"source", r.ground.source}};
  json["objects"] = list_of(r.objects, [](const FoundObject& f, std::size_t) { return object_of(f); });
  json["people"] = list_of(r.people, [](const Person& p, std::size_t) { return person_of(p); });
  json["windows"] = list_of(r.windows, [](const Window& w, std::size_t) { return window_of(w); });
  json["evidence"] = {{"origin", {number(r.evidence.origin.x()), number(r.evidence.origin.y())}},
                      {"cell", number(r.evidence.cell)},
                      {"columns", r.evidence.columns},
                      {"rows", r.evidence.rows},
                      {"turns", EvidenceMap::kTurns}};
  return text_of(json);
}

}  // namespace unseen::report
