// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/rgbd_parts.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

/// The first of the names that is a file of the folder; empty if none is.
fs::path first_of(const fs::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  for (const std::string& name : names)
    if (fs::is_regular_file(folder / name, error)) return folder / name;
  return {};
}

RgbdFiles find_in_folder(const fs::path& folder) {
  const std::vector<std::string> depths = {"depth.png", "depth.tif", "depth.tiff", "depth.exr", "depth.pcd"};
  RgbdFiles files;
  files.frame = folder;
  files.depth = first_of(folder, depths);
  if (files.depth.empty())
    throw InputError(folder.string(), "depth", "no such file",
                     fmt::format("frame.json, or {}", fmt::join(depths, ", ")));
  files.color = first_of(folder, {"color.png", "rgb.png", "color.jpg", "rgb.jpg"});
  files.masks = first_of(folder, {"masks.png"});
  files.intrinsics = first_of(folder, {"intrinsics.json", "camera-intrinsics.txt"});
  return files;
}

}  // namespace

RgbdFiles read_frame_file(const fs::path& path) {
  constexpr std::size_t kLargest = std::size_t{8} << 20;
  RgbdFiles files;
  files.frame = path;
  files.json = parse_json(read_text_file(path, kLargest), path.string(), "a frame file");
  const JsonField json(*files.json, path.string());
  json.allow_only({"depth", "depth_scale", "color", "camera", "up", "masks", "supports", "strokes", "densities",
                   "cloud", "viewpoint"});
  const fs::path folder = path.parent_path();
  files.cloud = named_file(json, "cloud", folder);
  files.depth = named_file(json, "depth", folder);
  files.color = named_file(json, "color", folder);
  files.masks = named_file(json, "masks", folder);
  if (files.cloud.empty() == files.depth.empty())
    throw InputError(path.string(), "depth", files.depth.empty() ? "nothing" : "a depth image beside a cloud",
                     "the name of a depth image, or of a \"cloud\" with its \"viewpoint\"");
  if (files.cloud.empty() && json.has("viewpoint"))
    json["viewpoint"].fail("none beside \"depth\": the camera is the viewpoint");
  return files;
}

RgbdFiles find_rgbd_files(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(path.string(), "", "no such file or folder", "a frame file, or the folder of a frame");
  if (!fs::is_directory(path, error)) return read_frame_file(path);
  if (fs::is_regular_file(path / "frame.json", error)) return read_frame_file(path / "frame.json");
  return find_in_folder(path);
}

}  // namespace unseen::io
