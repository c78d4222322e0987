// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::io {

/// A depth image and where its camera stood.
struct DepthFrame {
  std::filesystem::path image;
  RigidTransform T_world_camera;
};

/// What a folder of depth frames holds.
struct DepthFolder {
  Camera camera;                   ///< without a size: the images have it
  std::vector<DepthFrame> frames;  ///< in the order of their names, those whose pose is usable
  std::vector<std::string> notes;  ///< one for each frame left out
};

/// A file of 9 numbers, the camera matrix row by row, or of 16, that with a fourth row and column; gives no size. Throws InputError.
Camera read_intrinsics_text(const std::filesystem::path& path);

/// True if a folder holds depth images or their intrinsics.
bool is_depth_folder(const std::filesystem::path& folder);
/// Throws InputError if the intrinsics are unusable or no frame is.
DepthFolder read_depth_folder(const std::filesystem::path& folder, int frame_step);

}  // namespace unseen::io
