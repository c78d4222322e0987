// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/depth_frames.h"

#include <algorithm>

#include "core/linear.h"
#include "io/file_bytes.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;
constexpr const char* kIntrinsics = "camera-intrinsics.txt";
constexpr double kMostSkew = 1e-3;  // of the focal length: less moves no point by a pixel
constexpr std::string_view kStart = "frame-", kDepth = ".depth.png";

/// `count` numbers, or `other`, wherever the lines break.
std::vector<double> read_numbers(const fs::path& path, std::size_t count, std::size_t other) {
  const auto bytes = FileBytes::open(path);
  const std::string_view text = bytes->view();
  if (text.size() > 100000)
    throw InputError(path.string(), "content", "a large file", std::to_string(count) + " numbers");
  std::vector<double> numbers;
  Lines lines(text);
  std::string_view line;
  while (lines.next_filled(line))
    for (const std::string_view word : words(line)) {
      double value = 0;
      if (!to_number(word, value))
        throw InputError(path.string(), "line " + std::to_string(lines.number()), shown(word), "a number");
      numbers.push_back(value);
    }
  if (numbers.size() != count && numbers.size() != other)
    throw InputError(path.string(), "content", count_of(numbers.size(), "number"), std::to_string(count));
  return numbers;
}

RigidTransform read_pose(const fs::path& path) {
  const std::vector<double> m = read_numbers(path, 16, 16);
  RigidTransform pose;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) pose.rotation(r, c) = m[static_cast<std::size_t>(4 * r + c)];
    pose.translation[r] = m[static_cast<std::size_t>(4 * r + 3)];
  }
  const bool last_row = m[12] == 0.0 && m[13] == 0.0 && m[14] == 0.0 && m[15] == 1.0;
  if (!pose.is_rigid(1e-2) || !last_row)
    throw InputError(path.string(), "pose", "a matrix that is not rigid",
                     "rotation and translation, camera to world");
  // Files round; the nearest rotation takes that out.
  pose.rotation = nearest_orthonormal(pose.rotation);
  return pose;
}

bool is_depth_image(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.size() > kStart.size() + kDepth.size() && name.compare(0, kStart.size(), kStart) == 0 &&
         name.compare(name.size() - kDepth.size(), kDepth.size(), kDepth) == 0;
}

}  // namespace

Camera read_intrinsics_text(const fs::path& path) {
  const std::vector<double> k = read_numbers(path, 9, 16);
  const std::size_t row = k.size() == 9 ? 3 : 4;
  Camera camera;
  camera.fx = k[0];
  camera.cx = k[2];
  camera.fy = k[row + 1];
  camera.cy = k[row + 2];
  if (!(camera.fx > 0.0 && camera.fy > 0.0) || !std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy))
    throw InputError(path.string(), "focal lengths",
                     std::to_string(camera.fx) + ", " + std::to_string(camera.fy),
                     "positive numbers of pixels");
  if (!(std::abs(k[1]) <= kMostSkew * camera.fx))
    throw InputError(path.string(), "skew", std::to_string(k[1]), "0, as of pixels with right angles");
  if (k[row] != 0.0 || k[2 * row] != 0.0 || k[2 * row + 1] != 0.0 || k[2 * row + 2] != 1.0)
    throw InputError(path.string(), "matrix", "numbers below its diagonal, or a last one that is not 1", "rows fx 0 cx, 0 fy cy, 0 0 1");
  return camera;
}

bool is_depth_folder(const fs::path& folder) {
  return fs::is_regular_file(folder / kIntrinsics) ||
         std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), [](const auto& entry) { return is_depth_image(entry.path()); });
}

DepthFolder read_depth_folder(const fs::path& folder, int frame_step) {
  if (!fs::exists(folder / kIntrinsics))
    throw InputError(folder.string(), kIntrinsics, "no such file", "the camera matrix of the frames, 9 numbers");
  DepthFolder result;
  result.camera = read_intrinsics_text(folder / kIntrinsics);
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_depth_image(entry.path())) images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  for (std::size_t i = 0; i < images.size(); i += static_cast<std::size_t>(frame_step)) {
    std::string pose = images[i].string();
    pose.replace(pose.size() - kDepth.size(), kDepth.size(), ".pose.txt");
    try {
      result.frames.push_back({images[i], read_pose(pose)});
    } catch (const InputError& error) {
      result.notes.push_back(std::string("frame left out: ") + error.what());
    }
  }
  if (result.frames.empty())
    throw InputError(
        folder.string(), "frames",
        result.notes.empty() ? "no frame-*.depth.png" : "none usable (" + result.notes.front() + ")",
        "frame-*.depth.png with frame-*.pose.txt");
  return result;
}

}  // namespace unseen::io
