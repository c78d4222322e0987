// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "unseen/interactions/scenelets.h"

namespace unseen::report {

/// Units of the file: joints in mm, boxes in µm, axes in 1e-9.
constexpr double kPerMetre = 1e3, kBoxPerMetre = 1e6, kAxesPerOne = 1e9;

/// Joints of a pose in the world, mm; column by column.
using PackedPose = std::array<std::int32_t, 3 * interactions::kJoints>;

/// Frames of one person that scenelets share.
struct PackedTrack {
  int recording = 0, person = 0, first_frame = 0;
  double fps = 10;
  std::vector<PackedPose> poses;
  std::vector<std::uint8_t> flags;  ///< action, +128 if the pose was recorded
};

constexpr std::uint8_t kRecorded = 128;

/// A scenelet as a part of a track.
struct PackedScenelet {
  std::uint32_t track = 0, first = 0, count = 0, middle = 0;
  std::vector<std::uint32_t> objects;
};

struct PackedDatabase {
  std::vector<PackedTrack> tracks;
  std::vector<std::pair<int, interactions::Object>> objects;  ///< recording, and the object in its world
  std::vector<PackedScenelet> scenelets;
};

/// The body of the file before zlib; layouts and saliencies come from the database itself.
std::string body_of(const PackedDatabase& packed, const interactions::Database& database);

/// Poses and objects that scenelets share, once.
PackedDatabase pack(const interactions::Database& database);

/// The scenelets of a body; `recordings` is how many there are. Throws InputError (`source`) whatever the bytes.
std::vector<interactions::Scenelet> scenelets_of(std::string_view body, std::size_t recordings, const std::string& source);

}  // namespace unseen::report
