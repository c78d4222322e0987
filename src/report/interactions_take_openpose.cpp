// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "report/i3db_parts.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFrame = std::size_t{4} << 20, kLargestFolder = std::size_t{4} << 30;

/// A tracker's number, −1 if there is none: [5], or 5, or [-1].
int identity(const JsonField& json) {
  if (!json.has("person_id")) return -1;
  const JsonField id = json["person_id"];
  const double value = id.is_array() ? (id.size() == 0 ? -1.0 : id.list(1)[0].number(-1, 1e9)) : id.number(-1, 1e9);
  return static_cast<int>(value);
}

void read_person(const JsonField& json, int frame, JointFile& joints) {
  const JsonField keypoints = json["pose_keypoints_2d"];
  const std::size_t size = keypoints.size();
  if (size != 75 && size != 54) keypoints.fail("75 numbers (BODY_25) or 54 (COCO-18)");
  std::vector<double> values;
  for (const JsonField& value : keypoints.list()) values.push_back(value.number(-1e6, 1e6));
  for (std::size_t i = 2; i < size; i += 3) joints.above_one += values[i] > 1.5;
  interactions::Detection d = detection_of(frame, values, size == 75 ? kBody25 : kCoco18);
  d.person = identity(json);
  joints.detections.push_back(d);
}

/// Other files may lie beside the frames, the take for one, whose "people" is a number.
bool is_frame(const nlohmann::json& json) { return json.is_object() && json.contains("people") && json["people"].is_array(); }

}  // namespace

JointFile read_openpose_joints(const fs::path& folder) {
  const auto files = paths_named(folder, "", ".json");
  if (files.empty()) throw InputError(folder.string(), "", "no JSON file", "one a frame, as OpenPose's --write_json makes them");
  JointFile joints;
  std::size_t bytes = 0;
  std::size_t frames = 0;
  for (const fs::path& file : files) {
    const std::string text = io::read_text_file(file, kLargestFrame);
    bytes += text.size();
    if (bytes > kLargestFolder) throw InputError(folder.string(), "", fmt::format("more than {} GiB of JSON", kLargestFolder >> 30), "a shorter take");
    const nlohmann::json parsed = io::parse_json(text, file.string(), "a frame of OpenPose");
    if (!is_frame(parsed)) continue;
    const int frame = last_number(file.stem().string());
    if (frame < 0) throw InputError(file.string(), "", "no number below ten million in the name", "a frame's, such as take_000000000012_keypoints.json");
    ++frames;
    for (const JsonField& person : JsonField(parsed, file.string())["people"].list(kMostDetections)) read_person(person, frame, joints);
    if (joints.detections.size() > kMostDetections)
      throw InputError(folder.string(), "", "more people", fmt::format("at most {} in all frames together", kMostDetections));
  }
  if (frames == 0) throw InputError(folder.string(), "", "no JSON file with a list of \"people\"", "one a frame, as OpenPose's --write_json makes them");
  return joints;
}

}  // namespace unseen::report
