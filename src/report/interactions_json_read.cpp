// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>
#include <set>

#include "report/result_read.h"
#include "unseen/report/interactions_result.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr std::size_t kMost = 1'000'000'000, kMostObjects = 500, kMostParts = 50, kMostPeople = 100, kMostResultFrames = 10'000'000;

Part part(const JsonField& json) {
  Part p;
  p.name = json["name"].text();
  p.box = {json["center"].vector(), read_axes(json["axes"]), 0.5 * json["size"].vector()};
  if (!(p.box.half_size.minCoeff() > 0.0)) json["size"].fail("three sizes above 0");
  return p;
}

/// "superclass", "center", "size" and "yaw" follow from the rest; a file that says otherwise was changed.
void check_summary_of(const JsonField& json, const Object& object) {
  constexpr double kRounding = 1e-6;
  const OrientedBox box = upright_box(object);
  if (json["superclass"].text() != kSuperclasses[static_cast<int>(object.superclass())]) json["superclass"].fail("that of the category");
  if (!((json["center"].vector() - box.center).norm() < kRounding)) json["center"].fail("that of the box around the parts");
  if (!((json["size"].vector() - 2.0 * box.half_size).norm() < kRounding)) json["size"].fail("that of the box around the parts");
  const double yaw = json["yaw"].number(-7, 7);
  if (!(box.axes.col(0).head<2>() - Vec2(std::cos(yaw), std::sin(yaw))).isZero(kRounding)) json["yaw"].fail("that of the main part");
}

FoundObject object(const JsonField& json, std::set<int>& ids, std::size_t windows) {
  FoundObject f;
  f.object.id = new_id(json["id"], ids);
  f.object.category = json["category"].text();
  for (const JsonField& field : json["parts"].list(kMostParts)) f.object.parts.push_back(part(field));
  if (f.object.parts.empty()) json["parts"].fail("at least one");
  check_summary_of(json, f.object);
  f.confidence = json["confidence"].number(0, 1);
  f.windows = json["windows"].indices(windows);
  return f;
}

PersonFrame frame(const JsonField& json) {
  PersonFrame f;
  f.frame = json["frame"].index(kMostResultFrames);
  const auto joints = json["joints"].list(kJoints), confidence = json["confidence"].list(kJoints);
  if (joints.size() != kJoints) json["joints"].fail("16 joints");
  if (confidence.size() != kJoints) json["confidence"].fail("16 numbers");
  for (std::size_t j = 0; j < kJoints; ++j) {
    f.pose.col(static_cast<Eigen::Index>(j)) = joints[j].vector();
    f.confidence[static_cast<Eigen::Index>(j)] = confidence[j].number(0, 1);
  }
  f.source = kind_of<PoseSource>(json["source"], kPoseSources);
  f.action = kind_of<Action>(json["action"], kActions);
  return f;
}

Person person(const JsonField& json, std::set<int>& ids) {
  Person p;
  p.id = new_id(json["id"], ids);
  for (const JsonField& field : json["frames"].list(kMostResultFrames)) {
    p.frames.push_back(frame(field));
    if (p.frames.size() > 1 && p.frames.back().frame <= p.frames[p.frames.size() - 2].frame) field["frame"].fail("a frame after the one before");
  }
  for (const JsonField& field : json["likelihood"].list(kMostResultFrames)) p.likelihood.push_back(field.number(0, 1));
  if (p.likelihood.size() != p.frames.size()) json["likelihood"].fail("one a frame");
  return p;
}

Window window(const JsonField& json) {
  Window w;
  w.person = json["person"].index(kMost);
  w.first = json["first"].index(kMostResultFrames);
  w.last = json["last"].index(kMostResultFrames);
  if (w.last < w.first) json["last"].fail("at least first");
  w.scenelet = json["scenelet"].text();
  w.likelihood = json["likelihood"].number();
  w.energy = json["energy"].number();
  w.placement = {json["position"].vector(), json["yaw"].number()};
  return w;
}

/// Where the evidence map lies; the map itself is a file of its own.
EvidenceMap evidence(const JsonField& json) {
  EvidenceMap e;
  const auto origin = json["origin"].list(2);
  if (origin.size() != 2) json["origin"].fail("two numbers");
  e.origin = Vec2(origin[0].number(), origin[1].number());
  e.cell = json["cell"].number(0);
  e.columns = json["columns"].index(kMost);
  e.rows = json["rows"].index(kMost);
  if (json["turns"].count() != static_cast<std::size_t>(EvidenceMap::kTurns)) json["turns"].fail("16");
  return e;
}

}  // namespace

Reconstruction parse_interactions_result(const std::string& text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonField json(parsed, source);
  if (json["schema"].count() != 1) json["schema"].fail("1");
  if (json["capability"].text() != "interactions") json["capability"].fail("\"interactions\"");
  Reconstruction r;
  r.summary = read_summary(json["summary"], text);
  r.T_world_camera = read_transform(json["T_world_camera"]);
  r.camera = read_camera(json["camera"]);
  r.fps = json["fps"].number(0);
  const JsonField ground = json["ground"];
  r.ground = {ground["camera_height"].number(), radians(ground["pitch_deg"].number(-180, 180)), radians(ground["roll_deg"].number(-180, 180)),
              ground["source"].text()};
  for (const JsonField& field : json["windows"].list(kMostResultFrames)) r.windows.push_back(window(field));
  std::set<int> objects, people;
  for (const JsonField& field : json["objects"].list(kMostObjects)) r.objects.push_back(object(field, objects, r.windows.size()));
  for (const JsonField& field : json["people"].list(kMostPeople)) r.people.push_back(person(field, people));
  r.evidence = evidence(json["evidence"]);
  return r;
}

Reconstruction read_interactions_result(const std::filesystem::path& path) {
  return parse_interactions_result(read_result_text(path), path.string());
}

}  // namespace unseen::report
