// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/json_field.h"
#include "unseen/interactions/types.h"

// What the files of an i3DB scene folder have in common: detections, initial poses, truth, and the original method's output.
namespace unseen::report {

using io::JsonField;

/// The most that one JSON file of joints may hold, and the most frames that a recording may have.
inline constexpr std::size_t kLargestJoints = std::size_t{128} << 20, kMostFrames = 10'000'000;

/// A JSON file of at most `kLargestJoints` bytes. Throws InputError, `expected` in its message.
nlohmann::json parse_joint_file(const std::filesystem::path& path, const std::string& expected);

/// The files (or folders) of `folder` whose name starts and ends so, sorted by name. Throws InputError if it is no folder.
std::vector<std::filesystem::path> paths_named(const std::filesystem::path& folder, const std::string& begin, const std::string& end);

/// {"00001": {"0": [x, y, z], …, "15": …}} by frame. Throws InputError for a frame named twice, a missing joint or one too many.
std::map<int, interactions::Pose> read_i3db_poses(const JsonField& json);

/// {"frame_ids": [1, …], "values": [{"0": c, …}, …]} by frame; NaN for a joint that has no value.
std::map<int, interactions::PerJoint> read_i3db_values(const JsonField& json);

/// The boxes NN_label_part.json of a folder, in the coordinates of the camera; NN is the object. The axes are the file's.
std::vector<interactions::Object> read_i3db_objects(const std::filesystem::path& folder);

/// The box in the world: `T` times it, its axes ordered so that the last one is nearest to up.
OrientedBox upright(const RigidTransform& T, const OrientedBox& box);

}  // namespace unseen::report
