// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/rgbd.h"

#include <fmt/format.h>

#include <cmath>

#include "io/depth_frames.h"
#include "io/rgbd_parts.h"
#include "unseen/core/error.h"
#include "unseen/io/points.h"

namespace unseen::io {
namespace {

constexpr std::size_t kLargestJson = std::size_t{8} << 20;
constexpr double kMillimetres = 1000.0;  ///< units a metre of 16-bit images that say nothing else

/// Depth in metres; what cannot be a measurement becomes 0.
std::vector<float> in_metres(const StoredDepth& stored, double scale) {
  constexpr float kSaturated = 65535.0f;
  std::vector<float> depth(stored.values.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float value = stored.values[i];
    const bool measured = std::isfinite(value) && value > 0.0f && !(stored.whole_numbers && value == kSaturated);
    const double metres = measured ? value / scale : 0.0;
    depth[i] = metres < 1e9 ? static_cast<float>(metres) : 0.0f;
  }
  return depth;
}

/// Where the camera's numbers come from: the frame file, an intrinsics file, or an organised cloud.
Camera camera_of(const RgbdFiles& files, const StoredDepth& stored) {
  if (files.json && files.json->contains("camera"))
    return read_camera(JsonField(*files.json, files.frame.string())["camera"]);
  if (files.intrinsics.extension() == ".txt") return read_intrinsics_text(files.intrinsics);
  if (!files.intrinsics.empty()) {
    const nlohmann::json json = parse_json(read_text_file(files.intrinsics, kLargestJson), files.intrinsics.string(),
                                           "the intrinsics of a camera");
    return read_camera(JsonField(json, files.intrinsics.string()));
  }
  if (stored.camera) return *stored.camera;
  if (!files.json)
    throw InputError(files.frame.string(), "camera", "no intrinsics.json or camera-intrinsics.txt",
                     "one of them beside the depth image, or a frame.json with \"camera\"");
  throw InputError(files.frame.string(), "camera", "nothing", "fx, fy, cx and cy in pixels");
}

double scale_of(const RgbdFiles& files, const StoredDepth& stored) {
  std::optional<double> scale;
  if (files.json) scale = read_depth_scale(JsonField(*files.json, files.frame.string()));
  return scale.value_or(stored.whole_numbers ? kMillimetres : 1.0);
}

void read_images(const RgbdFiles& files, RgbdFrame& frame) {
  StoredDepth stored = read_stored_depth(files.depth);
  frame.camera = camera_of(files, stored);
  frame.camera.width = stored.width;
  frame.camera.height = stored.height;
  const double scale = scale_of(files, stored);
  frame.depth = in_metres(stored, scale);
  check_depths(frame.depth, files.depth.string(), scale);
  frame.color = files.color.empty() ? std::move(stored.colors) : read_color(files.color, frame.camera);
  if (!files.masks.empty()) frame.masks = read_masks(files.masks, frame.camera);
}

void read_cloud(const RgbdFiles& files, RgbdFrame& frame) {
  const JsonField json(*files.json, files.frame.string());
  for (const char* key : {"camera", "depth_scale", "color", "masks", "strokes"})
    if (json.has(key)) throw InputError(files.frame.string(), key, "a field of depth images", "none beside \"cloud\"");
  frame.cloud = read_all(*open_points(files.cloud));
  if (json.has("viewpoint")) frame.cloud.viewpoint = json["viewpoint"].vector();
  if (!frame.cloud.viewpoint)
    throw InputError(files.frame.string(), "viewpoint", "nothing", "[x, y, z]: where the cloud was seen from");
  check_distances(frame.cloud, files.cloud.string());
}

void read_hints(const RgbdFiles& files, RgbdFrame& frame) {
  if (!files.json) return;
  const JsonField json(*files.json, files.frame.string());
  frame.up = read_up(json);
  frame.supports = read_supports(json);
  frame.strokes = read_strokes(json, frame.camera);
  frame.densities = read_densities(json);
}

}  // namespace

RgbdFrame read_rgbd_frame(const std::filesystem::path& path) {
  const RgbdFiles files = find_rgbd_files(path);
  RgbdFrame frame;
  frame.name = path.string();
  if (files.cloud.empty())
    read_images(files, frame);
  else
    read_cloud(files, frame);
  read_hints(files, frame);
  return frame;
}

}  // namespace unseen::io
