// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <functional>

#include "perception_scenes.h"

namespace unseen::cuboids::test {

using Color = std::array<double, 3>;  // linear, 0 … 1
constexpr Color kRed{0.6, 0.12, 0.1}, kGreen{0.15, 0.5, 0.15}, kBlue{0.1, 0.2, 0.6}, kYellow{0.6, 0.5, 0.08}, kBrown{0.5, 0.3, 0.15}, kWhite{0.7, 0.7, 0.7};

inline std::array<std::uint8_t, 3> srgb(const Color& color, double light) {
  std::array<std::uint8_t, 3> out{};
  for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(color[k] * light, 1.0 / 2.2)));
  return out;
}

/// The scene with what lies on the boxes painted by place and side (2 · axis + (positive side)), each side under a light of its own.
inline RgbdFrame painted(const Scene& scene, const std::function<Color(const Vec3& world, int side)>& paint) {
  RgbdFrame frame = render(scene);
  const RigidTransform T = camera_of(scene);
  for (int v = 0; v < scene.image_height; ++v)
    for (int u = 0; u < scene.width; ++u) {
      auto& pixel = frame.color[static_cast<std::size_t>(v) * scene.width + u];
      pixel = srgb({0.2, 0.2, 0.2}, 1.0);
      const Vec3 ray = T.rotation * frame.camera.unproject(u, v, 1.0);
      double nearest = ray.z() < 0.0 ? -scene.height / ray.z() : std::numeric_limits<double>::infinity();
      for (const OrientedBox& box : scene.boxes)
        if (const auto [t, side] = hit(box, T.translation, ray); t < nearest) nearest = t, pixel = srgb(paint(T * (frame.camera.unproject(u, v, 1.0) * t), side), side == 5 ? 1.0 : 0.45 + 0.1 * side);
    }
  return frame;
}

/// Boxes side by side and one upon another, flush on all sides; `first` is the lower left one.
inline Scene wall(int along, int up, const Vec3& size) {
  Scene scene;
  scene.height = 0.8;
  for (int k = 0; k < up; ++k)
    for (int i = 0; i < along; ++i) scene.boxes.push_back(upright((i - 0.5 * (along - 1)) * size.x(), 1.2, k * size.z(), size, 0));
  return scene;
}

}  // namespace unseen::cuboids::test
