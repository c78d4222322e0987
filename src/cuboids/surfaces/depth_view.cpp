// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/depth_view.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr double kSigmas = 3.0;
constexpr int kMinSphereHeight = 90, kMaxSphereHeight = 1440;

/// Azimuth and elevation of a direction as a place in an image of all directions.
Vec2 sphere_pixel(const Vec3& direction, int width, int height) {
  const double azimuth = std::atan2(direction.y(), direction.x());
  const double elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  return {(azimuth / (2.0 * kPi) + 0.5) * width, (0.5 - elevation / kPi) * height};
}

}  // namespace

DepthView::DepthView(const RgbdFrame& frame, const RigidTransform& T_world_camera, double noise)
    : camera_(frame.camera), T_world_camera_(T_world_camera), T_camera_world_(T_world_camera.inverse()), noise_(noise) {
  if (!frame.is_fused()) {
    width_ = camera_.width;
    height_ = camera_.height;
    depth_ = frame.depth;
    return;
  }
  // So many directions that most of them hold a few points; the nearest counts.
  const double directions = static_cast<double>(frame.cloud.size()) / 4.0;
  height_ = std::clamp(static_cast<int>(std::sqrt(directions / 2.0)), kMinSphereHeight, kMaxSphereHeight);
  width_ = 2 * height_;
  depth_.assign(static_cast<std::size_t>(width_) * height_, 0.0f);
  for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
    if (!frame.cloud.positions[i].allFinite()) continue;
    const Pixel pixel = project(T_world_camera_ * frame.cloud_point(i));
    if (pixel.index < 0) continue;
    float& depth = depth_[pixel.index];
    if (depth == 0.0f || pixel.depth < depth) depth = static_cast<float>(pixel.depth);
  }
}

DepthView::Pixel DepthView::project(const Vec3& world) const {
  Pixel pixel;
  double u = 0, v = 0;
  if (camera_.width > 0) {
    const Vec3 p = T_camera_world_ * world;
    pixel.depth = p.z();
    if (p.z() <= 0.0) return pixel;
    const Vec2 place = camera_.project(p);
    u = std::floor(place.x() + 0.5);
    v = std::floor(place.y() + 0.5);
  } else {
    const Vec3 ray = world - T_world_camera_.translation;
    pixel.depth = ray.norm();
    const Vec2 place = sphere_pixel(ray, width_, height_);
    u = std::min<double>(std::floor(place.x()), width_ - 1);
    v = std::min<double>(std::floor(place.y()), height_ - 1);
  }
  if (u >= 0 && v >= 0 && u < width_ && v < height_)
    pixel.index = static_cast<int>(v) * width_ + static_cast<int>(u);
  return pixel;
}

DepthView::Space DepthView::at(const Vec3& world) const {
  const Pixel pixel = project(world);
  if (pixel.index < 0) return Space::outside;
  const double measured = depth_[pixel.index];
  if (!(measured > 0.0)) return Space::missing;
  const double tolerance = kSigmas * noise_ * measured * measured;
  if (measured > pixel.depth + tolerance) return Space::free;
  return measured < pixel.depth - tolerance ? Space::hidden : Space::surface;
}

Vec3 DepthView::point_at(int x, int y) const {
  const double depth = depth_[static_cast<std::size_t>(y) * width_ + x];
  if (camera_.width > 0) return T_world_camera_ * Vec3(depth * (x - camera_.cx) / camera_.fx, depth * (y - camera_.cy) / camera_.fy, depth);
  const double azimuth = ((x + 0.5) / width_ - 0.5) * 2.0 * kPi, elevation = (0.5 - (y + 0.5) / height_) * kPi;
  return T_world_camera_.translation + depth * Vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
}

std::vector<Vec3> DepthView::measured_in(const OrientedBox& box, double margin) const {
  // The rectangle of the picture that the corners span; all of it where one is not in front of the camera.
  int left = width_, right = -1, top = height_, bottom = -1;
  for (int corner = 0; corner < 8 && camera_.width > 0; ++corner) {
    const Vec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const Vec3 p = T_camera_world_ * (box.center + box.axes * sign.cwiseProduct(box.half_size + Vec3::Constant(margin)));
    if (p.z() <= 1e-3) {
      left = top = 0, right = width_ - 1, bottom = height_ - 1;
      break;
    }
    const Vec2 place = camera_.project(p).cwiseMax(-1.0).cwiseMin(std::max(width_, height_));
    left = std::min(left, static_cast<int>(std::floor(place.x()))), right = std::max(right, static_cast<int>(std::ceil(place.x())));
    top = std::min(top, static_cast<int>(std::floor(place.y()))), bottom = std::max(bottom, static_cast<int>(std::ceil(place.y())));
  }
  if (camera_.width <= 0) left = top = 0, right = width_ - 1, bottom = height_ - 1;
  std::vector<Vec3> points;
  for (int y = std::max(top, 0); y <= std::min(bottom, height_ - 1); ++y)
    for (int x = std::max(left, 0); x <= std::min(right, width_ - 1); ++x) {
      if (!(depth_[static_cast<std::size_t>(y) * width_ + x] > 0.0f)) continue;
      const Vec3 p = point_at(x, y);
      if (((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).maxCoeff() <= margin) points.push_back(p);
    }
  return points;
}

double DepthView::sigma(const Vec3& world) const {
  const double depth = project(world).depth;
  return noise_ * depth * depth;
}

double DepthView::spacing(const Vec3& world) const {
  const double depth = std::abs(project(world).depth);
  return camera_.width > 0 ? depth / std::min(camera_.fx, camera_.fy) : depth * kPi / height_;
}

}  // namespace unseen::cuboids
