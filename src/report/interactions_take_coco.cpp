// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "report/i3db_parts.h"
#include "report/interactions_take_parts.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr std::size_t kNumbers = 51;
constexpr JointMap kCoco17 = {16, 14, 12, 11, 13, 15, -1, -1, -1, 0, 10, 8, 6, 5, 7, 9};
constexpr double kLabelledButHidden = 0.25;

struct Annotation {
  int frame = 0, person = -1;
  std::vector<double> keypoints;
};

int frame_of(const JsonField& id) {
  if (!id.is_text()) return id.index(kMostFrames);
  const int frame = last_number(id.text());
  if (frame < 0) id.fail("a frame, or the name of a picture with its number");
  return frame;
}

Annotation read_annotation(const JsonField& json) {
  Annotation a;
  a.frame = frame_of(json["image_id"]);
  if (json.has("track_id") && !json["track_id"].is_null()) a.person = json["track_id"].index(kMostFrames);
  const JsonField keypoints = json["keypoints"];
  if (keypoints.size() != kNumbers) keypoints.fail("51 numbers: x, y and confidence of 17 keypoints");
  for (const JsonField& value : keypoints.list()) a.keypoints.push_back(value.number(-1e6, 1e6));
  return a;
}

/// The third numbers are 0, 1 or 2 throughout, some of them 2: labels of a person, not confidences of a network.
bool are_flags(const std::vector<Annotation>& all) {
  bool some_two = false;
  for (const Annotation& a : all)
    for (std::size_t i = 2; i < kNumbers; i += 3) {
      const double c = a.keypoints[i];
      if (c != 0.0 && c != 1.0 && c != 2.0) return false;
      some_two = some_two || c == 2.0;
    }
  return some_two;
}

}  // namespace

JointFile read_coco_joints(const std::filesystem::path& file) {
  const nlohmann::json parsed = parse_joint_file(file, "COCO keypoints");
  const JsonField json(parsed, file.string());
  std::vector<Annotation> all;
  for (const JsonField& field : (json.is_array() ? json : json["annotations"]).list(kMostDetections)) all.push_back(read_annotation(field));
  const bool flags = are_flags(all);
  JointFile joints;
  for (Annotation& a : all) {
    for (std::size_t i = 2; i < kNumbers; i += 3) {
      double& c = a.keypoints[i];
      if (flags) c = c == 2.0 ? 1.0 : c * kLabelledButHidden;
      joints.above_one += c > 1.5;
    }
    joints.detections.push_back(detection_of(a.frame, a.keypoints, kCoco17));
    joints.detections.back().person = a.person;
  }
  if (!json.has("images")) return joints;
  for (const JsonField& image : json["images"].list(kMostDetections)) {
    if (!image.has("width") || !image.has("height")) continue;
    joints.width = image["width"].index(100'000);
    joints.height = image["height"].index(100'000);
    break;  // a take is one camera's
  }
  return joints;
}

}  // namespace unseen::report
