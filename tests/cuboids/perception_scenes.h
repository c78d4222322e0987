// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cuboids/objects/cuts.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/observation.h"
#include "unseen/core/random.h"

namespace unseen::cuboids::test {

/// Boxes on the plane z = 0, seen by a camera that looks down; rendered in closed form.
struct Scene {
  std::vector<OrientedBox> boxes;
  double height = 0.6, pitch = radians(35.0);  ///< of the camera above the ground, below the horizon
  double roll = 0.0;                           ///< of the camera about its axis, clockwise as it looks
  double noise = 0.0015;                       ///< σ of the depth at 1 m
  double ground_end = 10.0;                    ///< m, how far the ground goes
  int dropout = 0;                             ///< pixels without depth along silhouettes
  int width = 640, image_height = 480;
  double focal = 525;
};

inline OrientedBox upright(double x, double y, double bottom, const Vec3& size, double yaw_degrees) {
  OrientedBox box;
  const double c = std::cos(radians(yaw_degrees)), s = std::sin(radians(yaw_degrees));
  box.axes.col(0) = Vec3(c, s, 0);
  box.axes.col(1) = Vec3(-s, c, 0);
  box.half_size = 0.5 * size;
  box.center = Vec3(x, y, bottom + 0.5 * size.z());
  return box;
}

inline RigidTransform camera_of(const Scene& scene) {
  const double c = std::cos(scene.pitch), s = std::sin(scene.pitch);
  RigidTransform T;
  T.rotation.col(0) = Vec3::UnitX();
  T.rotation.col(1) = Vec3(0, -s, -c);
  T.rotation.col(2) = Vec3(0, c, -s);
  T.rotation = T.rotation * Eigen::AngleAxisd(scene.roll, Vec3::UnitZ()).toRotationMatrix();
  T.translation = Vec3(0, 0, scene.height);
  return T;
}

/// Distance along a ray to a box and the side hit (2 · axis + (positive side)); infinite = missed.
inline std::pair<double, int> hit(const OrientedBox& box, const Vec3& from, const Vec3& ray) {
  const Vec3 o = box.axes.transpose() * (from - box.center), d = box.axes.transpose() * ray;
  double near = -std::numeric_limits<double>::infinity(), far = -near;
  int side = -1;
  for (int k = 0; k < 3; ++k) {
    const double a = (-box.half_size[k] - o[k]) / d[k], b = (box.half_size[k] - o[k]) / d[k];
    if (std::min(a, b) > near) near = std::min(a, b), side = 2 * k + (d[k] < 0.0);
    far = std::min(far, std::max(a, b));
  }
  return near <= far && near > 0.0 ? std::pair{near, side} : std::pair{std::numeric_limits<double>::infinity(), -1};
}

/// Depth and colour: every side of every box has its own shade; the ground is grey.
inline RgbdFrame render(const Scene& scene, std::uint64_t seed = 1) {
  RgbdFrame frame;
  frame.name = "rendered";
  frame.camera = {scene.focal, scene.focal, 0.5 * scene.width - 0.5, 0.5 * scene.image_height - 0.5, scene.width, scene.image_height};
  const RigidTransform T = camera_of(scene);
  std::vector<int> owner;
  Random random(seed);
  for (int v = 0; v < scene.image_height; ++v)
    for (int u = 0; u < scene.width; ++u) {
      const Vec3 ray = T.rotation * frame.camera.unproject(u, v, 1.0);
      double depth = std::numeric_limits<double>::infinity();
      int what = -1;
      if (ray.z() < 0.0) {
        const double t = -scene.height / ray.z();
        if (t * ray.y() < scene.ground_end) depth = t, what = 0;
      }
      for (std::size_t b = 0; b < scene.boxes.size(); ++b)
        if (const auto [t, side] = hit(scene.boxes[b], T.translation, ray); t < depth) depth = t, what = static_cast<int>(8 * (b + 1)) + side;
      if (std::isfinite(depth)) depth += scene.noise * depth * depth * random.normal();
      frame.depth.push_back(std::isfinite(depth) ? static_cast<float>(depth) : 0.0f);
      owner.push_back(what / 8);
      const auto shade = static_cast<std::uint8_t>(what <= 0 ? 60 : 110 + 26 * (what % 8));
      frame.color.push_back({shade, shade, static_cast<std::uint8_t>((what / 8 * 120) % 256)});
    }
  const std::vector<float> full = frame.depth;
  for (int v = 0; v < scene.image_height && scene.dropout > 0; ++v)
    for (int u = 0; u < scene.width; ++u)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        for (int k = 1; k <= scene.dropout; ++k) {
          const int x = u + k * dx, y = v + k * dy;
          if (x < 0 || y < 0 || x >= scene.width || y >= scene.image_height) continue;
          const std::size_t i = static_cast<std::size_t>(v) * scene.width + u, j = static_cast<std::size_t>(y) * scene.width + x;
          if (owner[i] > 0 && owner[i] != owner[j] && full[j] > full[i] + 0.02f) frame.depth[i] = 0.0f;
        }
  return frame;
}

struct Perceived {
  Observation seen;
  std::vector<ObjectPart> parts;
  std::vector<Cuboid> fitted, cuboids;  ///< before and after the image's edges
};

inline Perceived perceive(const RgbdFrame& frame, Options options = {}, int threads = 2) {
  Context context;
  context.threads = threads;
  Perceived p;
  p.seen = observe(frame, options, context);
  const DepthView view(frame, p.seen.T_world_camera, depth_noise(frame, options));
  p.parts = cut_parts(p.seen, view, find_objects(frame, p.seen, options, context), context);
  p.fitted = p.cuboids = fit_cuboids(frame, p.seen, p.parts, view, options, context);
  align_to_image_edges(frame, p.seen, view, p.cuboids, options, context);
  return p;
}

/// The cuboid whose centre is nearest.
inline const Cuboid& nearest(const std::vector<Cuboid>& cuboids, const Vec3& center) {
  return *std::min_element(cuboids.begin(), cuboids.end(), [&](const Cuboid& a, const Cuboid& b) {
    return (a.box.center - center).norm() < (b.box.center - center).norm();
  });
}

/// Angle between the turns of two upright boxes, modulo a quarter, degrees.
inline double turn_between(const OrientedBox& a, const OrientedBox& b) {
  const double ya = std::atan2(a.axes(1, 0), a.axes(0, 0)), yb = std::atan2(b.axes(1, 0), b.axes(0, 0));
  return std::abs(degrees(std::remainder(ya - yb, 0.5 * kPi)));
}

/// Largest difference of sorted sizes, m.
inline double size_error(const OrientedBox& a, const OrientedBox& b) {
  Vec3 x = 2.0 * a.half_size, y = 2.0 * b.half_size;
  std::sort(x.data(), x.data() + 3);
  std::sort(y.data(), y.data() + 3);
  return (x - y).cwiseAbs().maxCoeff();
}

}  // namespace unseen::cuboids::test
