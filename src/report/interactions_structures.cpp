// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/interactions_structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace unseen::report {
namespace {

using namespace interactions;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr int kSuperclassCount = 4;
constexpr double kPictureDepth = 0.5;  ///< m: where the page draws the picture of a camera
constexpr double kSeen = 0.2;          ///< detections of a lower confidence are not drawn
constexpr double kFloorCell = 1.0;     ///< m

/// The frames of all series, and the one after each, so that who is not there is not drawn in between.
std::vector<int> frames_and_gaps(const std::set<int>& there) {
  std::set<int> frames = there;
  for (const int f : there)
    if (f < *there.rbegin()) frames.insert(f + 1);
  return {frames.begin(), frames.end()};
}

std::vector<float> times_of(const std::vector<int>& frames, double fps) {
  std::vector<float> times;
  for (const int f : frames) times.push_back(static_cast<float>(f / fps));
  return times;
}

void write_skeleton(SceneBuilder& scene, Json& to, const std::vector<int>& frames, double fps, const std::vector<Vec3>& joints) {
  to["times"] = scene.scalars(times_of(frames, fps));
  to["joints"] = scene.vectors(joints);
  std::vector<std::array<int, 2>> bones;
  for (const auto& [parent, child] : kBones) bones.push_back({parent, child});
  to["bones"] = scene.pairs(bones);
  to["joint_count"] = kJoints;
}

/// Person by person (names from the fifth on: the first colours belong to superclasses).
Json person_quantity(SceneBuilder& scene, const Reconstruction& r, const std::vector<int>& labels) {
  Json label = quantity("person", "Person", "label", scene.integers(labels));
  label["names"] = std::vector<std::string>(kSuperclassCount, "");
  for (const Person& p : r.people) label["names"].push_back(name_of(p));
  return label;
}

Json ratio(SceneBuilder& scene, std::string_view id, std::string_view name, const std::vector<float>& values) {
  Json json = quantity(id, name, "scalar", scene.scalars(values));
  json["low"] = 0.0;
  json["high"] = 1.0;
  return json;
}

template <std::size_t n>
Json named(Json json, const char* const (&names)[n]) {
  json["names"] = std::vector<std::string>(names, names + n);
  return json;
}

Vec3 on_picture(const Reconstruction& r, const Vec2& pixel) {
  return r.T_world_camera *
         Vec3((pixel.x() - r.camera.cx) / r.camera.fx * kPictureDepth, (pixel.y() - r.camera.cy) / r.camera.fy * kPictureDepth, kPictureDepth);
}

}  // namespace

std::string name_of(const FoundObject& object) {
  return fmt::format("{} {}", object.object.category, object.object.id);
}
std::string name_of(const Person& person) {
  return fmt::format("person {}", person.id);
}
int person_label(std::size_t index) {
  return kSuperclassCount + static_cast<int>(index);
}

Eigen::AlignedBox3d reach_of(const Reconstruction& r) {
  Eigen::AlignedBox3d box;
  for (const FoundObject& o : r.objects)
    for (const Part& part : o.object.parts) {
      const Vec3 half = part.box.axes.cwiseAbs() * part.box.half_size;
      box.extend(part.box.center - half);
      box.extend(part.box.center + half);
    }
  for (const Person& p : r.people)
    for (const PersonFrame& f : p.frames)
      for (int j = 0; j < kJoints; ++j) box.extend(f.pose.col(j));
  return box;
}

void add_floor(SceneBuilder& scene, const Reconstruction& r) {
  Eigen::AlignedBox3d box = reach_of(r);
  box.extend(r.T_world_camera.translation);
  Json& floor = scene.add("floor", "floor", "Floor, 1 m grid");
  Json low = Json::array(), high = Json::array();
  for (int a = 0; a < 2; ++a) {
    low.push_back(std::floor(box.min()[a] / kFloorCell - 0.2) * kFloorCell);
    high.push_back(std::ceil(box.max()[a] / kFloorCell + 0.2) * kFloorCell);
  }
  floor["low"] = low;
  floor["high"] = high;
  floor["height"] = 0.0;
  floor["cell"] = kFloorCell;
}

void add_evidence(SceneBuilder& scene, const EvidenceMap& map, const std::string& png, int pixels_per_cell) {
  constexpr double kAbove = 0.005;  // m, so that it is not lost in the grid
  Json& image = scene.add("image", "evidence-picture", "Evidence from above: where furniture stands");
  image["width"] = map.columns * pixels_per_cell;
  image["height"] = map.rows * pixels_per_cell;
  image["format"] = "image/png";
  image["data"] = scene.bytes(png);
  Json& floor = scene.add("floor", "evidence", "Evidence, on the floor");
  floor["visible"] = false;
  floor["low"] = {number(map.origin.x()), number(map.origin.y())};
  floor["high"] = {number(map.origin.x() + map.columns * map.cell), number(map.origin.y() + map.rows * map.cell)};
  floor["height"] = kAbove;
  floor["image"] = "evidence-picture";
}

void add_objects(SceneBuilder& scene, const Reconstruction& r) {
  std::vector<Vec3> centers, sizes;
  std::vector<float> rotations, confidence;
  std::vector<int> of, superclass;
  Json labels = Json::array();
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    const FoundObject& found = r.objects[i];
    for (const Part& part : found.object.parts) {
      centers.push_back(part.box.center);
      sizes.push_back(2.0 * part.box.half_size);
      const Eigen::Quaterniond q(part.box.axes);
      for (const double c : {q.w(), q.x(), q.y(), q.z()}) rotations.push_back(static_cast<float>(c));
      of.push_back(static_cast<int>(i));
    }
    superclass.push_back(static_cast<int>(found.object.superclass()));
    confidence.push_back(static_cast<float>(found.confidence));
    labels.push_back(fmt::format("{} {:.2f}", found.object.category, found.confidence));
  }
  if (of.empty()) return;
  Json& boxes = scene.add("boxes", "objects", "Objects");
  boxes["element"] = "object";
  boxes["labels"] = std::move(labels);
  boxes["centers"] = scene.positions(centers);
  boxes["rotations"] = scene.quaternions(rotations);
  boxes["sizes"] = scene.vectors(sizes);
  boxes["of"] = scene.integers(of);
  boxes["quantities"] = {named(quantity("superclass", "Used to", "label", scene.integers(superclass)), kSuperclasses),
                         ratio(scene, "confidence", "Confidence", confidence)};
}

void add_people(SceneBuilder& scene, const Reconstruction& r) {
  std::set<int> there;
  for (const Person& p : r.people)
    for (const PersonFrame& f : p.frames) there.insert(f.frame);
  if (there.empty()) return;
  const std::vector<int> frames = frames_and_gaps(there);
  std::vector<Vec3> joints;
  std::vector<int> labels;
  for (std::size_t p = 0; p < r.people.size(); ++p) {
    std::map<int, const Pose*> poses;
    for (const PersonFrame& f : r.people[p].frames) poses[f.frame] = &f.pose;
    for (const int frame : frames) {
      const auto at = poses.find(frame);
      for (int j = 0; j < kJoints; ++j) joints.push_back(at == poses.end() ? Vec3(Vec3::Constant(kNone)) : Vec3(at->second->col(j)));
    }
    labels.push_back(person_label(p));
  }
  Json& people = scene.add("skeleton", "people", "People");
  write_skeleton(scene, people, frames, r.fps, joints);
  people["quantities"].push_back(person_quantity(scene, r, labels));
  scene.header["time"] = {{"start", number(frames.front() / r.fps)}, {"end", number(frames.back() / r.fps)}};
}

void add_paths(SceneBuilder& scene, const Reconstruction& r) {
  std::vector<Vec3> ends;
  std::vector<int> person, action, source;
  std::vector<float> likelihood;
  for (std::size_t p = 0; p < r.people.size(); ++p) {
    const std::vector<PersonFrame>& frames = r.people[p].frames;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
      if (frames[i + 1].frame != frames[i].frame + 1) continue;
      ends.push_back(frames[i].pose.col(pelvis));
      ends.push_back(frames[i + 1].pose.col(pelvis));
      person.push_back(person_label(p));
      action.push_back(static_cast<int>(frames[i].action));
      source.push_back(static_cast<int>(frames[i].source));
      likelihood.push_back(i < r.people[p].likelihood.size() ? static_cast<float>(r.people[p].likelihood[i]) : kNone);
    }
  }
  if (person.empty()) return;
  Json& paths = scene.add("lines", "paths", "Paths of the pelvis");
  paths["element"] = "step";
  paths["vertices"] = scene.positions(ends);
  paths["quantities"] = {ratio(scene, "likelihood", "Interaction likelihood", likelihood), person_quantity(scene, r, person),
                         named(quantity("action", "Action", "label", scene.integers(action)), kActions),
                         named(quantity("source", "Pose from", "label", scene.integers(source)), kPoseSources)};
}

void add_camera(SceneBuilder& scene, const Reconstruction& r) {
  if (!(r.camera.fx > 0) || !(r.camera.fy > 0) || r.camera.width <= 0 || r.camera.height <= 0) return;
  write_camera(scene.add("camera", "camera", "Camera"), r.T_world_camera, r.camera);
}

void add_detections(SceneBuilder& scene, const Reconstruction& r, const Take& take) {
  std::map<int, std::vector<const Detection*>> by_frame;
  std::set<int> there;
  std::size_t most = 0;
  for (const Detection& d : take.detections) {
    by_frame[d.frame].push_back(&d);
    there.insert(d.frame);
    most = std::max(most, by_frame[d.frame].size());
  }
  if (there.empty() || !(r.camera.fx > 0) || !(r.camera.fy > 0)) return;
  const std::vector<int> frames = frames_and_gaps(there);
  std::vector<Vec3> joints;
  for (std::size_t k = 0; k < most; ++k)
    for (const int frame : frames) {
      const auto at = by_frame.find(frame);
      const Detection* d = at != by_frame.end() && k < at->second.size() ? at->second[k] : nullptr;
      for (int j = 0; j < kJoints; ++j)
        joints.push_back(d && d->confidence[j] >= kSeen ? on_picture(r, d->pixels.col(j)) : Vec3(Vec3::Constant(kNone)));
    }
  Json& seen = scene.add("skeleton", "detections", "Detections, in the camera");
  seen["element"] = "detection";
  seen["width"] = 2;
  seen["steps"] = true;
  write_skeleton(scene, seen, frames, r.fps, joints);
  seen["quantities"].push_back(quantity("detection", "Detection", "label", scene.integers(std::vector<int>(most, -1))));
}

}  // namespace unseen::report
