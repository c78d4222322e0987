// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/engine_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {

std::string mujoco_contact(double friction) {
  return fmt::format(R"(friction="{:.9g} 0.005 0.0001" solref="0.004 1" solimp="0.7 0.95 0.0005")", friction);
}

Vec3 half_size_for_mujoco(const OrientedBox& box) {
  constexpr double kHair = 1e-4;    // m
  constexpr double kUpright = 0.9;  // cosine
  Vec3 half = (box.half_size.array() - kHair).max(0.5 * box.half_size.array());
  for (int k = 0; k < 3; ++k)
    if (std::abs(box.axes(2, k)) > kUpright) half[k] = box.half_size[k] + kHair;
  return half;
}

OrientedBox slab_behind(const Plane& plane, const std::vector<Vec3>& polygon) {
  constexpr double kThickness = 0.02;  // m
  OrientedBox slab;
  const Vec3 side = polygon[1] - polygon[0];
  slab.axes.col(2) = plane.normal;
  slab.axes.col(0) = (side - side.dot(plane.normal) * plane.normal).normalized();
  slab.axes.col(1) = plane.normal.cross(slab.axes.col(0));
  Eigen::AlignedBox3d reach;
  for (const Vec3& p : polygon) reach.extend(Vec3(slab.axes.transpose() * p));
  Vec3 center = reach.center();
  center.z() = plane.offset - 0.5 * kThickness;
  slab.center = slab.axes * center;
  slab.half_size = 0.5 * reach.sizes();
  slab.half_size.z() = 0.5 * kThickness;
  return slab;
}

bool is_half_space(std::span<const Support> supports, std::size_t support, std::span<const OrientedBox> boxes) {
  const Support& s = supports[support];
  if (s.outline.size() < 3) return true;
  return support == 0 && std::all_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) { return s.plane.signed_distance(box.center) > 0.0; });
}

}  // namespace unseen::cuboids
