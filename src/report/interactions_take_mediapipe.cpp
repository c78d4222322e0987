// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/i3db_parts.h"
#include "report/interactions_take_parts.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr std::size_t kLandmarks = 33;
constexpr JointMap kPose33 = {28, 26, 24, 23, 25, 27, -1, -1, -1, 0, 16, 14, 12, 11, 13, 15};

struct Landmark {
  Vec3 place = Vec3::Zero();
  double visibility = 1;
};

bool is_landmark(const JsonField& json) { return json.has("x") || (json.is_array() && json.size() > 0 && json.list(kLandmarks)[0].is_number()); }

Landmark read_landmark(const JsonField& json) {
  constexpr double kMost = 1e3;  // shares of the picture, or m
  Landmark l;
  if (json.is_array()) {
    const auto values = json.list(5);
    if (values.size() < 4) json.fail("x, y, z and visibility");
    for (int i = 0; i < 3; ++i) l.place[i] = values[static_cast<std::size_t>(i)].number(-kMost, kMost);
    l.visibility = values[3].number(-kMost, kMost);
    return l;
  }
  l.place = Vec3(json["x"].number(-kMost, kMost), json["y"].number(-kMost, kMost), json.has("z") ? json["z"].number(-kMost, kMost) : 0.0);
  if (json.has("visibility")) l.visibility = json["visibility"].number(-kMost, kMost);
  return l;
}

std::vector<Landmark> read_landmarks(const JsonField& json) {
  if (json.size() != kLandmarks) json.fail("33 landmarks");
  std::vector<Landmark> landmarks;
  for (const JsonField& field : json.list()) landmarks.push_back(read_landmark(field));
  return landmarks;
}

/// Landmarks of one person, or a list of people, or null.
std::vector<JsonField> people_of(const JsonField& json) {
  if (json.is_null()) return {};
  if (json.is_object() && json.has("landmark")) return {json["landmark"]};  // as the protocol buffer prints
  if (json.size() == 0) return {};
  auto entries = json.list(kMostDetections);
  if (is_landmark(entries[0])) return {json};
  return entries;
}

/// The member of that name, with the prefix that some programs give it or without.
std::vector<JsonField> people_named(const JsonField& json, const std::string& name) {
  for (const std::string& key : {name, "pose_" + name})
    if (json.has(key)) return people_of(json[key]);
  return {};
}

Pose pose_of(const std::vector<Landmark>& landmarks) {
  Pose pose = Pose::Zero();
  for (int j = 0; j < kJoints; ++j)
    if (const int from = kPose33[static_cast<std::size_t>(j)]; from >= 0) pose.col(j) = landmarks[static_cast<std::size_t>(from)].place;
  make_from_neighbours(pose);
  return root_centred(pose);
}

void add_person(int frame, const JsonField& landmarks, const JsonField* world, int width, int height, JointFile& joints) {
  std::vector<double> keypoints;
  for (const Landmark& l : read_landmarks(landmarks)) {
    keypoints.push_back(l.place.x() * width);
    keypoints.push_back(l.place.y() * height);
    keypoints.push_back(l.visibility);
    joints.above_one += l.visibility > 1.5;
  }
  joints.detections.push_back(detection_of(frame, keypoints, kPose33));
  if (world) joints.detections.back().local = pose_of(read_landmarks(*world));
}

void read_frame(const JsonField& json, int frame, int width, int height, JointFile& joints) {
  if (!json.is_object() || json.has("landmark")) {
    for (const JsonField& person : people_of(json)) add_person(frame, person, nullptr, width, height, joints);
    return;
  }
  if (!json.has("landmarks") && !json.has("pose_landmarks")) json.fail("\"landmarks\"");
  const auto people = people_named(json, "landmarks"), worlds = people_named(json, "world_landmarks");
  if (!worlds.empty() && worlds.size() != people.size()) json.fail("as many world landmarks as landmarks");
  for (std::size_t p = 0; p < people.size(); ++p) add_person(frame, people[p], worlds.empty() ? nullptr : &worlds[p], width, height, joints);
}

}  // namespace

JointFile read_mediapipe_joints(const std::filesystem::path& file, int width, int height) {
  const nlohmann::json parsed = parse_joint_file(file, "MediaPipe landmarks");
  const JsonField json(parsed, file.string());
  JointFile joints;
  int frame = 0;
  for (const JsonField& field : (json.is_array() ? json : json["frames"]).list(kMostDetections)) {
    if (field.has("frame")) frame = field["frame"].index(kMostFrames);
    read_frame(field, frame, width, height, joints);
    ++frame;
  }
  return joints;
}

}  // namespace unseen::report
