// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/json_field.h"
#include "unseen/core/rgbd_frame.h"

namespace unseen::io {

/// Which files a frame is made of, and what its frame file says beside.
struct RgbdFiles {
  std::filesystem::path frame;                       ///< the frame file, or the folder that has none
  std::filesystem::path depth, color, masks, cloud;  ///< empty = none
  std::filesystem::path intrinsics;                  ///< of a folder without frame file
  std::optional<nlohmann::json> json;                ///< the frame file
};

/// What a path means. Throws InputError if there is no frame.
RgbdFiles find_rgbd_files(const std::filesystem::path& path);
/// What a frame file names; paths are relative to its folder.
RgbdFiles read_frame_file(const std::filesystem::path& path);

/// A depth image as stored.
struct StoredDepth {
  int width = 0, height = 0;
  std::vector<float> values;  ///< row by row; NaN = not measured
  bool whole_numbers = false;  ///< a 16-bit image, whose unit is open
  std::optional<Camera> camera;  ///< an organised cloud says what camera it came from
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< of an organised cloud, or empty
};
StoredDepth read_stored_depth(const std::filesystem::path& path);
StoredDepth read_exr_depth(std::string_view bytes, const std::string& name);

/// sRGB, row by row; must have the size of the depth image.
std::vector<std::array<std::uint8_t, 3>> read_color(const std::filesystem::path& path, const Camera& camera);
/// An object a pixel: grey values, or one object a colour. Must have the camera's size; messages say whose it is.
std::vector<std::int32_t> read_masks(const std::filesystem::path& path, const Camera& camera, const std::string& whose = "the depth image");

/// Focal lengths and principal point of "camera", or of an intrinsics file (fx, fy, cx, cy or Open3D's
/// intrinsic_matrix).
Camera read_camera(const JsonField& json);
std::optional<double> read_depth_scale(const JsonField& json);
std::optional<Vec3> read_up(const JsonField& json);
std::vector<GivenSupport> read_supports(const JsonField& json);
/// Points must lie in a picture of that size.
std::vector<Stroke> read_strokes(const JsonField& json, const Camera& camera);
std::map<std::string, double> read_densities(const JsonField& json);

/// Throws InputError if no depth is known, or if they cannot be metres; `scale` is what they were divided by.
void check_depths(const std::vector<float>& depths, const std::string& name, double scale);
/// The same for distances of a fused cloud from its viewpoint.
void check_distances(const PointCloud& cloud, const std::string& name);

}  // namespace unseen::io
