// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/json_field.h"
#include "unseen/interactions/types.h"

// The formats of joints that read_take() knows, one file each, and what they share.
namespace unseen::report {

using io::JsonField;

/// A million people in frames is ten hours of one person.
inline constexpr std::size_t kMostDetections = 1'000'000, kMostInFrame = 200;

/// What a file or folder of joints says. Pixels are of the picture; `person` is what a tracker called somebody, −1 if nothing did.
struct JointFile {
  std::vector<interactions::Detection> detections;  ///< in the file's order
  int width = 0, height = 0;                        ///< of the picture, if the file says so
  std::size_t above_one = 0;                        ///< confidences far above 1, which count as 1
};

/// A folder with a JSON file a frame.
JointFile read_openpose_joints(const std::filesystem::path& folder);
/// One file of keypoints.
JointFile read_coco_joints(const std::filesystem::path& file);
/// One file of landmarks, on pictures of that size.
JointFile read_mediapipe_joints(const std::filesystem::path& file, int width, int height);
/// A scene folder, on pictures of that height.
JointFile read_i3db_joints(const std::filesystem::path& folder, int height);

/// The keypoint of a format that is each of our joints; −1: made from neighbours.
using JointMap = std::array<int, interactions::kJoints>;
/// Those of OpenPose.
inline constexpr JointMap kBody25 = {11, 10, 9, 12, 13, 14, 8, 1, -1, 0, 4, 3, 2, 5, 6, 7};
inline constexpr JointMap kCoco18 = {10, 9, 8, 11, 12, 13, -1, 1, -1, 0, 4, 3, 2, 5, 6, 7};

/// A detection of the keypoints of a format, given as x, y, confidence each. Confidence is clamped to [0,1].
interactions::Detection detection_of(int frame, std::span<const double> keypoints, const JointMap& map);

/// Gives pelvis (between the hips), thorax (between the shoulders) and neck (between thorax and head), where they have no confidence,
/// a place and the lowest confidence of their neighbours.
void make_from_neighbours(interactions::Detection& detection);
/// The same three of a 3D pose.
void make_from_neighbours(interactions::Pose& pose);
/// Moves the pelvis to the origin.
interactions::Pose root_centred(const interactions::Pose& pose);

/// The last number in a text, below ten million; −1 if there is none.
int last_number(const std::string& text);

/// The initial 3D poses of "lifted" become `local` of the detections they stand beside. Throws InputError if they cannot be metres.
void read_lifted(const std::filesystem::path& file, std::vector<interactions::Detection>& detections);

/// A take's camera as its file has it: fx = 0 if only the field of view is known, width = 0 if no size is.
struct GivenCamera {
  Camera camera;
  std::optional<double> hfov;  ///< rad
  bool assumed = false;
};
struct PictureSize {
  int width = 0, height = 0;
};
/// What i3DB has, and most cameras.
inline constexpr PictureSize kUsualPicture = {1920, 1080};

/// The size as given, or as the joints' file says, or, with a remark, guessed: from the principal point, or from where joints are.
PictureSize picture_size(const GivenCamera& given, const JointFile* joints, std::vector<std::string>& remarks);
Camera resolved_camera(const GivenCamera& given, const PictureSize& size);
/// Throws InputError if all joints are shares of the picture, not pixels.
void check_pixels(const std::vector<interactions::Detection>& detections, const std::string& source);
/// Remarks on it if joints lie outside the picture in more than a tenth of the detections.
void remark_on_places(interactions::Take& take);

/// Sorts by frame, makes a tracker's names 0, 1, …, joins detections that are the same, and remarks on what is odd. `source` names the
/// joints in messages. Throws InputError if nobody is there, or somebody twice in a frame.
void tidy_detections(interactions::Take& take, const std::string& source);

}  // namespace unseen::report
