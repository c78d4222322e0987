// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids::photo_fixture {

using Color = std::array<std::uint8_t, 3>;

inline constexpr int kWidth = 320, kHeight = 240;
inline const Camera kCamera = {260, 260, 159.5, 119.5, kWidth, kHeight};

/// Stands 1.2 m above the ground and looks down on the origin from the south.
inline RigidTransform pose() {
  const Vec3 eye(0.0, -1.2, 1.2), forward = (Vec3(0, 0, 0.05) - eye).normalized(), right = Vec3::UnitX();
  RigidTransform T;
  T.rotation << right, forward.cross(right), forward;
  T.translation = eye;
  return T;
}

/// Planks of 9 cm along x with dark joints; each has its own tone.
inline Color ground_color(const Vec3& p) {
  const double y = p.y() / 0.09, plank = std::floor(y);
  if (y - plank < 0.12) return {80, 70, 60};
  const double tone = 150.0 + 30.0 * std::sin(2.3 * plank) + 8.0 * std::sin(3.0 * p.x());
  return {static_cast<std::uint8_t>(tone + 20), static_cast<std::uint8_t>(tone), static_cast<std::uint8_t>(tone - 40)};
}

/// Every face has a colour of its own, with a mark that says where on the face one is.
inline Color box_color(const Vec3& local, int axis, bool positive) {
  const double u = local[(axis + 1) % 3], v = local[(axis + 2) % 3];
  const int base = 60 + 30 * axis + (positive ? 90 : 0);
  const int mark = std::sin(40.0 * u) * std::sin(40.0 * v) > 0.0 ? 25 : 0;
  return {static_cast<std::uint8_t>(base), static_cast<std::uint8_t>(mark + 40), static_cast<std::uint8_t>(220 - base + mark)};
}

struct Picture {
  RgbdFrame frame;
  std::vector<int> box;  ///< index a pixel, −1 = ground
};

/// Ray by ray, face by face.
inline Picture render(const std::vector<OrientedBox>& boxes, const RigidTransform& T_world_camera = pose()) {
  Picture out;
  out.frame.name = "memory";
  out.frame.camera = kCamera;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Vec3 origin = T_world_camera.translation, direction = T_world_camera.rotation * kCamera.unproject(x, y, 1.0);
      double depth = direction.z() < 0.0 ? -origin.z() / direction.z() : std::numeric_limits<double>::infinity();
      Color color = std::isfinite(depth) ? ground_color(origin + depth * direction) : Color{0, 0, 0};
      int found = -1;
      for (std::size_t b = 0; b < boxes.size(); ++b)
        for (int axis = 0; axis < 3; ++axis)
          for (const double side : {-1.0, 1.0}) {
            const OrientedBox& box = boxes[b];
            const Vec3 normal = side * box.axes.col(axis);
            if (normal.dot(direction) >= 0.0) continue;
            const double at = (normal.dot(box.center - origin) + box.half_size[axis]) / normal.dot(direction);
            const Vec3 local = box.axes.transpose() * (origin + at * direction - box.center);
            const int j = (axis + 1) % 3, k = (axis + 2) % 3;
            if (at >= depth || at <= 0.0 || std::abs(local[j]) > box.half_size[j] || std::abs(local[k]) > box.half_size[k]) continue;
            depth = at;
            color = box_color(local, axis, side > 0.0);
            found = static_cast<int>(b);
          }
      out.frame.depth.push_back(std::isfinite(depth) ? static_cast<float>(depth) : 0.0f);
      out.frame.color.push_back(color);
      out.box.push_back(found);
    }
  return out;
}

inline OrientedBox box_at(const Vec3& bottom, const Vec3& size, double yaw = 0.0) {
  return {bottom + Vec3(0, 0, 0.5 * size.z()), Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), 0.5 * size};
}

/// Ground with id 0 and the boxes with ids from 1.
inline Completion scene_of(const std::vector<OrientedBox>& boxes) {
  Completion scene;
  scene.T_world_camera = pose();
  scene.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    Cuboid cuboid;
    cuboid.id = static_cast<int>(b) + 1;
    cuboid.box = cuboid.initial = boxes[b];
    scene.cuboids.push_back(cuboid);
  }
  return scene;
}

/// dB over the marked pixels.
inline double psnr(const std::vector<Color>& a, const std::vector<Color>& b, const std::function<bool(std::size_t)>& marked) {
  double squared = 0.0, count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3 && marked(i); ++k) {
      squared += std::pow(static_cast<double>(a[i][k]) - b[i][k], 2);
      ++count;
    }
  return count == 0.0 ? 0.0 : 10.0 * std::log10(255.0 * 255.0 / std::max(squared / count, 1e-9));
}

}  // namespace unseen::cuboids::photo_fixture
