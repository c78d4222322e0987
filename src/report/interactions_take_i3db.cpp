// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "report/i3db_parts.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace interactions;

constexpr double kDetectorHeight = 368.0;  // px, of the pictures that the detector saw
constexpr std::string_view kDetections = "_2d_00.json", kInitial = "_unannot.json";

/// As the original program maps the raw scores of its detector, which are around 0.002.
double normalized(double score) { return 1.0 / (1.0 + std::exp(-5000.0 * score + 9.5)); }

std::map<int, Pose> read_initial_poses(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const nlohmann::json parsed = parse_joint_file(path, "initial 3D poses of a scene");
  return read_i3db_poses(JsonField(parsed, path.string())["3d"]);
}

/// Pelvis and neck have a place but no confidence of their own.
PerJoint confidence_of(const PerJoint& values, bool already_normalized) {
  PerJoint c = PerJoint::Zero();
  for (int j = 0; j < kJoints; ++j)
    if (std::isfinite(values[j])) c[j] = already_normalized ? std::clamp(values[j], 0.0, 1.0) : normalized(values[j]);
  if (!std::isfinite(values[pelvis])) c[pelvis] = std::min(c[left_hip], c[right_hip]);
  if (!std::isfinite(values[neck])) c[neck] = std::min(c[thorax], c[head]);
  return c;
}

void read_person(const fs::path& path, int person, double scale, std::vector<Detection>& detections) {
  const nlohmann::json parsed = parse_joint_file(path, "the detections of a scene");
  const JsonField json(parsed, path.string());
  const bool already = json.has("confidence_normalized") && json["confidence_normalized"].truth();
  const auto places = read_i3db_poses(json["3d"]);
  const auto values = read_i3db_values(json["confidence"]);
  const std::string name = path.string();
  const auto initial = read_initial_poses(name.substr(0, name.size() - kDetections.size()) + std::string(kInitial));
  for (const auto& [frame, place] : places) {
    const auto value = values.find(frame);
    if (value == values.end()) throw InputError(name, "confidence.frame_ids", "no frame " + std::to_string(frame), "every frame of \"3d\"");
    Detection d;
    d.frame = frame;
    d.person = person;
    d.pixels = scale * place.topRows<2>();
    d.confidence = confidence_of(value->second, already);
    if (const auto pose = initial.find(frame); pose != initial.end()) d.local = root_centred(pose->second);
    detections.push_back(d);
  }
}

}  // namespace

JointFile read_i3db_joints(const fs::path& folder, int height) {
  const auto people = paths_named(folder, "skel_", std::string(kDetections));
  if (people.empty()) throw InputError(folder.string(), "", "no skel_NAME" + std::string(kDetections), "one a person");
  JointFile joints;
  for (std::size_t p = 0; p < people.size(); ++p) read_person(people[p], static_cast<int>(p), height / kDetectorHeight, joints.detections);
  return joints;
}

}  // namespace unseen::report
