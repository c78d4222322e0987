// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/interactions_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/json_write.h"

namespace unseen::report {
namespace {

using namespace interactions;

/// The places of our joints in BODY_25; −1: none.
constexpr std::array<int, kJoints> kBody25 = {11, 10, 9, 12, 13, 14, 8, 1, -1, 0, 4, 3, 2, 5, 6, 7};
constexpr std::size_t kBody25Joints = 25;

/// To so many decimals, which keeps files short.
Json rounded(double value, double steps) { return number(std::round(value * steps) / steps); }
Json point_of(const Vec3& p) { return {rounded(p.x(), 1e7), rounded(p.y(), 1e7), rounded(p.z(), 1e7)}; }

std::map<int, std::vector<const Detection*>> by_frame(const Take& take) {
  std::map<int, std::vector<const Detection*>> frames;
  for (const Detection& d : take.detections) frames[d.frame].push_back(&d);
  return frames;
}

std::string keypoints_text(const std::vector<const Detection*>& detections) {
  Json people = Json::array();
  for (const Detection* d : detections) {
    std::vector<Json> numbers(3 * kBody25Joints, 0.0);
    for (std::size_t j = 0; j < kJoints; ++j) {
      if (kBody25[j] < 0) continue;
      const auto at = 3 * static_cast<std::size_t>(kBody25[j]);
      const auto column = static_cast<Eigen::Index>(j);
      numbers[at] = rounded(d->pixels(0, column), 1e3);
      numbers[at + 1] = rounded(d->pixels(1, column), 1e3);
      numbers[at + 2] = rounded(d->confidence[column], 1e6);
    }
    people.push_back({{"person_id", {d->person}}, {"pose_keypoints_2d", numbers}});
  }
  return Json{{"version", 1.3}, {"people", people}}.dump() + "\n";
}

Json joints_of(const Pose& pose) {
  Json list = Json::array();
  for (int j = 0; j < kJoints; ++j) list.push_back(point_of(pose.col(j)));
  return list;
}

std::string lifted_text(const Take& take) {
  Json frames = Json::array();
  const auto pose_of = [](const Detection* d, std::size_t) { return d->local ? joints_of(*d->local) : Json(nullptr); };
  for (const auto& [frame, detections] : by_frame(take)) frames.push_back({{"frame", frame}, {"people", list_of(detections, pose_of)}});
  return Json{{"frames", frames}}.dump() + "\n";
}

std::string take_text(const Take& take, bool lifted) {
  const Camera& c = take.camera;
  Json json = {{"camera", {{"fx", number(c.fx)}, {"fy", number(c.fy)}, {"cx", number(c.cx)}, {"cy", number(c.cy)}, {"width", c.width}, {"height", c.height}}},
               {"fps", number(take.fps)},
               {"joints", "joints"},
               {"format", "openpose"},
               {"people", take.people}};
  if (lifted) json["lifted"] = "lifted.json";
  return text_of(json);
}

std::string joint_key(int j) { return std::to_string(j); }

/// One person's poses in camera coordinates, as i3DB has them.
std::string skeleton_text(const std::vector<RecordedFrame>& frames, const Recording& truth) {
  const RigidTransform to_camera = truth.T_world_camera.inverse();
  Json poses = Json::object(), occluded = Json::object(), forwards = Json::object(), numbers = Json::array(), seen = Json::array(), valid = Json::array(),
       times = Json::array();
  for (const RecordedFrame& frame : frames) {
    Json pose = Json::object(), visible = Json::object(), confidence = Json::object(), flags = Json::array();
    for (int j = 0; j < kJoints; ++j) {
      const bool hidden = frame.occluded[static_cast<std::size_t>(j)];
      pose[joint_key(j)] = point_of(to_camera * frame.pose.col(j));
      visible[joint_key(j)] = hidden ? 0 : 1;
      confidence[joint_key(j)] = 1.0;
      flags.push_back(hidden ? 1 : 0);
    }
    poses[fmt::format("{:05}", frame.frame)] = pose;
    occluded[std::to_string(frame.frame)] = flags;
    forwards[std::to_string(frame.frame)] = point_of(to_camera.rotation * facing(frame.pose));
    numbers.push_back(frame.frame);
    times.push_back(number(frame.frame / truth.fps));
    seen.push_back(visible);
    valid.push_back(confidence);
  }
  return Json{{"3d", poses},
              {"confidence", {{"frame_ids", numbers}, {"values", valid}}},
              {"confidence_normalized", true},
              {"forwards", forwards},
              {"frame_ids", times},
              {"occluded", occluded},
              {"visibility", {{"frame_ids", numbers}, {"values", seen}}}}
             .dump() +
         "\n";
}

std::string box_text(const OrientedBox& box, const RigidTransform& to_camera, std::size_t part) {
  const Mat3 axes = to_camera.rotation * box.axes;
  const Vec3 center = to_camera * box.center;
  Json rows = Json::array(), centroid = Json::array(), scales = Json::array();
  for (int r = 0; r < 3; ++r) {
    rows.push_back({number(axes(r, 0)), number(axes(r, 1)), number(axes(r, 2))});
    centroid.push_back(Json::array({number(center[r])}));
    scales.push_back(Json::array({number(2.0 * box.half_size[r])}));
  }
  return text_of({{"axes", rows}, {"centroid", centroid}, {"part_id", part}, {"scales", scales}});
}

std::string actions_text(const std::vector<RecordedFrame>& frames) {
  std::string text;
  for (const RecordedFrame& frame : frames) {
    const char* name = frame.action == Action::stand_up ? "standing(from sitting)" : kActions[static_cast<std::size_t>(frame.action)];  // i3DB's word
    text += fmt::format("{}\t{}\n", frame.frame, name);
  }
  return text;
}

}  // namespace

std::vector<SceneFile> interactions_scene_files(const SynthTake& synth, const OptionTable& options) {
  const Recording& truth = synth.truth;
  const Take& take = synth.take;
  const bool lifted = std::any_of(take.detections.begin(), take.detections.end(), [](const Detection& d) { return d.local.has_value(); });
  std::vector<SceneFile> files = {{"take.json", take_text(take, lifted)}};

  auto detections = by_frame(take);
  for (std::size_t f = 0; f < truth.people.at(0).size(); ++f) {
    const int frame = truth.people[0][f].frame;
    files.push_back({fmt::format("joints/{:06}_keypoints.json", frame), keypoints_text(detections[frame])});
  }
  if (lifted) files.push_back({"lifted.json", lifted_text(take)});

  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const std::string which = truth.people.size() > 1 ? fmt::format("-{}", p) : "";
    files.push_back({fmt::format("gt/skel_{}{}_GT.json", truth.name, which), skeleton_text(truth.people[p], truth)});
    files.push_back({p == 0 ? "gt/actions.txt" : fmt::format("gt/actions-{}.txt", p), actions_text(truth.people[p])});
  }
  const RigidTransform to_camera = truth.T_world_camera.inverse();
  for (const Object& object : truth.objects)
    for (std::size_t i = 0; i < object.parts.size(); ++i)
      files.push_back({fmt::format("gt/skel_{}_GT_objects/{:02}_{}_{}.json", truth.name, object.id, object.category, object.parts[i].name),
                       box_text(object.parts[i].box, to_camera, i)});
  files.push_back({"gt/interacted.json", Json(truth.interacted).dump() + "\n"});
  files.push_back({"gt/room.txt", truth.room + "\n"});
  files.push_back({"gt/licence.txt", truth.licence + "\n"});
  files.push_back({"synth.json", text_of(made_by("synth interactions", options))});
  return files;
}

}  // namespace unseen::report
