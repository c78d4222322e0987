// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/rgbd_parts.h"
#include "report/collision_shot_parts.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"
#include "unseen/report/interactions_take.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace interactions;

constexpr std::size_t kLargestTake = std::size_t{8} << 20, kMostPeopleOfTake = 16, kMostLabels = 10'000, kMostMasks = 100, kMostFrame = 10'000'000;

GivenCamera given_camera(const JsonField& json) {
  const collision::ShotCamera c = read_shot_camera(json);
  for (const double k : c.distortion)
    if (k != 0.0) json["camera"]["distortion"].fail("zeros: joints of a picture without distortion");
  if (c.readout.value_or(0.0) != 0.0) json["camera"]["readout"].fail("0: a rolling shutter is not undone for people");
  return {c.camera, c.hfov, c.assumed};
}

int read_people(const JsonField& json) {
  const double people = json.number(1, kMostPeopleOfTake);
  if (people != std::floor(people)) json.fail("a whole number");
  return static_cast<int>(people);
}

std::vector<Label> read_labels(const JsonField& json, int people) {
  std::vector<Label> labels;
  for (const JsonField& field : json.list(kMostLabels)) {
    field.allow_only({"frame", "person", "pixel"});
    Label label;
    label.frame = field["frame"].index(kMostFrame);
    label.person = field["person"].index(static_cast<std::size_t>(people));
    const auto pixel = field["pixel"].list(2);
    if (pixel.size() != 2) field["pixel"].fail("two numbers");
    label.pixel = Vec2(pixel[0].number(), pixel[1].number());
    labels.push_back(label);
  }
  return labels;
}

std::vector<Mask> read_masks(const JsonField& json, const fs::path& folder, const Camera& camera, std::vector<std::string>& remarks) {
  std::vector<Mask> masks;
  for (const JsonField& field : json.list(kMostMasks)) {
    field.allow_only({"category", "image"});
    (void)field["image"];
    Mask mask = {field["category"].text(), camera.width, camera.height, {}};
    for (const std::int32_t value : io::read_masks(io::named_file(field, "image", folder), camera, "the take's picture")) mask.inside.push_back(value != 0);
    if (superclass_of(mask.category) == Superclass::other)
      remarks.push_back(fmt::format("{} says nothing: \"{}\" is none of {}", field.path(), mask.category, fmt::join(kCategories.begin(), kCategories.end() - 1, ", ")));
    masks.push_back(std::move(mask));
  }
  return masks;
}

/// The joints, and the camera, whose size they may tell or need.
JointFile read_joints(Take& take, const JsonField& json, const fs::path& path) {
  const GivenCamera given = given_camera(json);
  take.camera_assumed = given.assumed;
  const std::string format = json["format"].text();
  const bool by_size = format == "i3db" || format == "mediapipe";
  PictureSize size = by_size ? picture_size(given, nullptr, take.remarks) : PictureSize{};
  JointFile joints;
  if (format == "openpose") joints = read_openpose_joints(path);
  else if (format == "coco") joints = read_coco_joints(path);
  else if (format == "mediapipe") joints = read_mediapipe_joints(path, size.width, size.height);
  else if (format == "i3db") joints = read_i3db_joints(path, size.height);
  else json["format"].fail("openpose, coco, mediapipe or i3db");
  if (!by_size) size = picture_size(given, &joints, take.remarks);
  take.camera = resolved_camera(given, size);
  return joints;
}

}  // namespace

Take read_take(const fs::path& path) {
  if (fs::is_directory(path)) throw InputError(path.string(), "", "a folder", "a take file: TAKE.json, whose \"joints\" names the folder of a detector's files");
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestTake), path.string(), "a take file");
  const JsonField json(parsed, path.string());
  const fs::path folder = path.parent_path();
  json.allow_only({"camera", "fps", "joints", "format", "people", "lifted", "up", "camera_height", "labels", "masks"});
  Take take;
  take.name = path.string();
  if (json.has("fps")) take.fps = json["fps"].number(0.1, 1e4);
  else take.remarks.push_back(fmt::format("no fps: {} assumed", take.fps));
  if (json.has("people")) take.people = read_people(json["people"]);
  (void)json["joints"];
  const fs::path place = io::named_file(json, "joints", folder);
  JointFile joints = read_joints(take, json, place);
  if (joints.above_one > 0) take.remarks.push_back(fmt::format("{} confidences far above 1 count as 1", joints.above_one));
  if (json.has("lifted")) read_lifted(io::named_file(json, "lifted", folder), joints.detections);
  take.detections = std::move(joints.detections);
  tidy_detections(take, place.string());
  check_pixels(take.detections, place.string());
  remark_on_places(take);
  if (json.has("up")) take.up = read_direction(json["up"]);
  if (json.has("camera_height")) take.camera_height = json["camera_height"].number(0.01, 100.0);
  if (json.has("labels")) take.labels = read_labels(json["labels"], take.people);
  if (json.has("masks")) take.masks = read_masks(json["masks"], folder, take.camera, take.remarks);
  return take;
}

}  // namespace unseen::report
