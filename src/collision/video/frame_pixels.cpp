// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/frame_pixels.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

namespace unseen::collision {
namespace {

bool distorted(const ShotCamera& camera) {
  return std::any_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k != 0.0; });
}

cv::Matx33d intrinsics(const Camera& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }

}  // namespace

void to_track_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage) {
  if (distorted(camera)) {
    const cv::Matx33d k = intrinsics(camera.camera);
    const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
    cv::undistortPoints(pixels, pixels, k, distortion, cv::noArray(), k);
  }
  if (!footage.shift.empty()) cv::transform(pixels, pixels, footage.shift[static_cast<std::size_t>(frame)]);
}

void to_frame_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage) {
  if (!footage.shift.empty()) {
    cv::Mat back;
    cv::invertAffineTransform(footage.shift[static_cast<std::size_t>(frame)], back);
    cv::transform(pixels, pixels, back);
  }
  if (!distorted(camera)) return;
  std::vector<cv::Point3d> rays;
  const Camera& c = camera.camera;
  for (const cv::Point2d& p : pixels) rays.emplace_back((p.x - c.cx) / c.fx, (p.y - c.cy) / c.fy, 1.0);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  cv::projectPoints(rays, cv::Vec3d::all(0), cv::Vec3d::all(0), intrinsics(c), distortion, pixels);
}

}  // namespace unseen::collision
