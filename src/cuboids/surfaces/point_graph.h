// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"

namespace unseen::cuboids {

/// Points with their measured neighbours on the same surface: no link crosses a jump of depth.
struct PointGraph {
  std::vector<int> start;      ///< links of point i: links[start[i]] … links[start[i + 1] − 1]
  std::vector<int> links;
  std::vector<Vec3> normals;   ///< unit, toward the viewpoint; zero = unknown
  std::vector<float> flatness; ///< rms distance of a point's surroundings to their plane, in σ; infinite = unknown
  std::vector<float> sigma;    ///< m, of a point along its ray
  std::vector<float> spacing;  ///< m, of neighbouring measurements across the ray

  std::span<const int> neighbours(int point) const {
    return std::span(links).subspan(start[point], start[point + 1] - start[point]);
  }
};

/// Points of a frame in the camera's coordinates (viewpoint at the origin), thinned if it is a large cloud.
struct Measured {
  std::vector<Vec3> points;
  std::vector<int> pixel_of_point, point_of_pixel;  ///< empty for a fused cloud
};
Measured measured_points(const RgbdFrame& frame);

/// Neighbours within `gap` (m; unset = from noise and spacing) and normals of their surroundings. `noise` is σ at 1 m.
PointGraph link_points(const RgbdFrame& frame, const Measured& measured, double noise, std::optional<double> gap,
                       const Context& context);

}  // namespace unseen::cuboids
