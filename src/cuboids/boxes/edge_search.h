// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "cuboids/surfaces/depth_view.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Edges of a colour image (Canny) with the direction across them.
class ImageEdges {
 public:
  explicit ImageEdges(const RgbdFrame& frame);
  /// How far from `p` along ±`across` (unit, pixels) there are edges within `reach` that run as asked.
  std::vector<double> offsets(const Vec2& p, const Vec2& across, double reach) const;
  /// Pixels to the nearest edge, at most 255; outside the picture 255.
  double distance(const Vec2& p) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> edge_;
  std::vector<float> direction_, distance_;  ///< rad, of the gradient; px
};

/// A point on an edge of a box: at `side` (−1 or 1) along axes i and j, at `share` of the length along axis k.
struct EdgeSample {
  int i = 0, j = 1, k = 2;
  double side_i = 1, side_j = 1, share = 0.5;
  bool crease = false;  ///< both sides are seen
  bool same_edge(const EdgeSample& o) const { return k == o.k && side_i == o.side_i && side_j == o.side_j; }
};
Vec3 local_point(const EdgeSample& sample, const Vec3& low, const Vec3& high);

/// For points along one straight edge, with the directions across it: how far away the picture's edge is, if most of
/// them agree on about one distance (print on a box rarely runs all along its edge). NaN = no edge at that point.
std::vector<double> agreed_offsets(const ImageEdges& edges, const std::vector<Vec2>& points, const std::vector<Vec2>& across,
                                   double reach);

/// Samples of those edges that the camera sees and where the thing itself ends or bends, not what is in front of it.
std::vector<EdgeSample> visible_edge_samples(const OrientedBox& box, const RgbdFrame& frame,
                                             const RigidTransform& T_world_camera, const DepthView& view);

}  // namespace unseen::cuboids
