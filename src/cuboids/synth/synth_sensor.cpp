// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/synth/synth_sensor.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr double kRange = 6.0;   // m
constexpr double kJump = 0.015;  // of the depth: a larger step between neighbours is an edge
// A step of 2.1 σ has a rounding error of 0.606 σ; what is left of σ comes before the rounding.
constexpr double kDisparityStep = 2.1, kBefore = 0.7953;

/// Places along a ray in the box's own axes: entry, and the axis of the face that it enters by.
RayHit hit_box(const OrientedBox& box, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = box.axes.transpose() * (origin - box.center), d = box.axes.transpose() * direction;
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0.0) {
      if (std::abs(o[k]) > box.half_size[k]) return {};
      continue;
    }
    const double sign = d[k] > 0 ? 1.0 : -1.0;
    const double in = (-sign * box.half_size[k] - o[k]) / d[k], out = (sign * box.half_size[k] - o[k]) / d[k];
    if (in > enter) {
      enter = in;
      axis = k;
    }
    leave = std::min(leave, out);
  }
  if (axis < 0 || enter > leave) return {};
  return {enter, 0, (d[axis] > 0 ? -1.0 : 1.0) * box.axes.col(axis)};
}

RayHit hit_support(const Support& support, const Vec3& origin, const Vec3& direction) {
  const double slope = support.plane.normal.dot(direction);
  if (slope >= 0) return {};
  const double distance = -support.plane.signed_distance(origin) / slope;
  if (distance <= 0) return {};
  const Vec3 p = origin + distance * direction;
  for (std::size_t i = 0; i < support.outline.size(); ++i) {
    const Vec3 &a = support.outline[i], &b = support.outline[(i + 1) % support.outline.size()];
    if (support.plane.normal.dot((b - a).cross(p - a)) < 0) return {};
  }
  return {distance, 0, support.plane.normal};
}

/// A colour for each box, hues far apart for neighbours in number.
Vec3 color_of(int body) {
  if (body == -1) return {0.62, 0.60, 0.57};
  if (body < 0) return {0.80, 0.79, 0.76};
  const double hue = std::fmod(0.11 + 0.61803398875 * body, 1.0) * 6.0;
  const double value = 0.95 - 0.08 * (body % 3), saturation = 0.65;
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue, 6.0);
    return value - value * saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
  };
  return {channel(5), channel(3), channel(1)};
}

std::array<std::uint8_t, 3> shade(const RayHit& hit) {
  const Vec3 light = Vec3(-0.35, -0.55, 0.95).normalized();
  const double bright = 0.45 + 0.40 * std::max(0.0, hit.normal.dot(light)) + 0.10 * std::abs(hit.normal.x());
  const Vec3 color = color_of(hit.body) * bright;
  std::array<std::uint8_t, 3> pixel;
  for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(color[k], 1 / 2.2)));
  return pixel;
}

/// True if a pixel within `radius` is nearer or farther by a jump, or has no depth.
bool near_edge(const std::vector<float>& depth, const Camera& camera, int u, int v, int radius) {
  const double here = depth[static_cast<std::size_t>(v) * camera.width + u];
  for (int y = std::max(v - radius, 0); y <= std::min(v + radius, camera.height - 1); ++y)
    for (int x = std::max(u - radius, 0); x <= std::min(u + radius, camera.width - 1); ++x)
      if (std::abs(depth[static_cast<std::size_t>(y) * camera.width + x] - here) > kJump * here) return true;
  return false;
}

}  // namespace

RayHit RayScene::first_hit(const Vec3& origin, const Vec3& direction) const {
  RayHit first;
  for (std::size_t i = 0; i < model_.boxes.size(); ++i) {
    if (!shown_[i]) continue;
    const RayHit hit = hit_box(model_.boxes[i], origin, direction);
    if (hit.distance < first.distance) {
      first = hit;
      first.body = static_cast<int>(i);
    }
  }
  for (std::size_t i = 0; i < model_.supports.size(); ++i) {
    const RayHit hit = hit_support(model_.supports[i], origin, direction);
    if (hit.distance < first.distance) {
      first = hit;
      first.body = -1 - static_cast<int>(i);
    }
  }
  return first;
}

void render(const SynthModel& model, const std::vector<bool>& shown, const RigidTransform& T_world_camera, SynthView& view,
            Context& context) {
  const Camera& camera = view.camera;
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
  view.exact_depth.assign(pixels, 0.0f);
  view.color.assign(pixels, {0, 0, 0});
  view.masks.assign(pixels, 0);
  const RayScene scene(model, shown);
  parallel_blocks(context, pixels, 1 << 13, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double u = static_cast<double>(i % camera.width), v = static_cast<double>(i / camera.width);
      const RayHit hit =
          scene.first_hit(T_world_camera.translation, T_world_camera.rotation * camera.unproject(u, v, 1.0));
      if (!std::isfinite(hit.distance)) continue;
      view.exact_depth[i] = static_cast<float>(hit.distance);
      view.color[i] = shade(hit);
      view.masks[i] = static_cast<std::uint16_t>(std::max(hit.body + 1, 0));
    }
  });
}

std::vector<float> measure(const std::vector<float>& exact, const Camera& camera, double noise, double dropout,
                           Random& random) {
  std::vector<float> measured(exact.size(), 0.0f);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double normal = random.normal(), chance = random.uniform();  // as many draws a pixel, whatever it shows
    const double depth = exact[i];
    if (depth <= 0.0 || depth > kRange) continue;
    const int u = static_cast<int>(i % camera.width), v = static_cast<int>(i / camera.width);
    if (chance < dropout && near_edge(exact, camera, u, v, 1)) continue;
    if (chance < dropout / 2 && near_edge(exact, camera, u, v, 2)) continue;
    double inverse = 1.0 / depth;
    if (noise > 0) {
      const double step = kDisparityStep * noise;
      inverse = std::round((inverse + kBefore * noise * normal) / step) * step;
    }
    if (inverse > 0) measured[i] = static_cast<float>(1.0 / inverse);
  }
  return measured;
}

}  // namespace unseen::cuboids
