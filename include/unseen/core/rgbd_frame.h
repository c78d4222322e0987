// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/point_cloud.h"

namespace unseen {

/// A line that a person drew on the picture to mark an object. Pixels.
struct Stroke {
  std::string label;
  std::vector<Vec2> points;
};

/// A static surface that a frame file names: normal·p = offset in the camera's coordinates.
struct GivenSupport {
  Plane plane;
  std::string kind;  ///< "ground", "desk", "wall" or "ceiling"
};

/// One RGB-D frame, or a fused cloud with the place that it was seen from, and what is known beside.
struct RgbdFrame {
  std::string name;    ///< for messages
  Camera camera;       ///< of the depth image; width 0 for a fused cloud
  std::vector<float> depth;  ///< m along the optical axis, row by row; 0 = unknown
  std::vector<std::array<std::uint8_t, 3>> color;  ///< sRGB, as many as depth, or empty
  std::vector<std::int32_t> masks;                 ///< object a pixel, 0 = none; as many as depth, or empty
  std::optional<Vec3> up;                          ///< unit, in the camera's coordinates
  std::vector<GivenSupport> supports;              ///< empty = to be found
  std::vector<Stroke> strokes;
  std::map<std::string, double> densities;  ///< kg/m³ by the label of an object or the number of its mask
  PointCloud cloud;                         ///< fused cloud instead of depth; its viewpoint is set

  bool is_fused() const { return camera.width == 0; }
  /// A point of the cloud in the camera's coordinates: the camera stands at the viewpoint and is turned like the cloud.
  Vec3 cloud_point(std::size_t i) const { return cloud.positions[i] - cloud.viewpoint.value_or(Vec3::Zero()); }
};

}  // namespace unseen
