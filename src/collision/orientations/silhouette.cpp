// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/silhouette.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace unseen::collision {

const Eigen::Matrix<double, kDirections, 2>& support_directions() {
  static const auto kAll = [] {
    Eigen::Matrix<double, kDirections, 2> d;
    for (int i = 0; i < kDirections; ++i) d.row(i) << std::cos(2.0 * kPi * i / kDirections), std::sin(2.0 * kPi * i / kDirections);
    return d;
  }();
  return kAll;
}

Support support_of(const Eigen::Matrix2Xd& points, const Vec2& origin) {
  const auto& directions = support_directions();
  Support most = directions * (points.col(0) - origin);
  for (Eigen::Index i = 1; i < points.cols(); ++i) most = most.cwiseMax(directions * (points.col(i) - origin));
  return most;
}

Eigen::Matrix2Xd projected(const Eigen::Matrix3Xd& vertices, const Quat& q, const Vec3& center, const Camera& camera) {
  constexpr double kNearest = 1e-2;  // m
  const Eigen::Matrix3Xd places = (q.toRotationMatrix() * vertices).colwise() + center;
  Eigen::Matrix2Xd pixels(2, vertices.cols());
  for (Eigen::Index i = 0; i < vertices.cols(); ++i) {
    const double z = std::max(places(2, i), kNearest);
    pixels.col(i) << camera.fx * places(0, i) / z + camera.cx, camera.fy * places(1, i) / z + camera.cy;
  }
  return pixels;
}

std::vector<Vec2> mask_outline(const cv::Mat& mask, double spur) {
  cv::Mat clean;
  const int margin = static_cast<int>(std::ceil(spur)) + 1;
  cv::copyMakeBorder(mask, clean, margin, margin, margin, margin, cv::BORDER_CONSTANT, cv::Scalar(0));
  const int width = 2 * static_cast<int>(0.5 * spur) + 1;
  if (width > 1) cv::morphologyEx(clean, clean, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {width, width}));
  std::vector<cv::Point2f> corners, hull;
  for (int v = 0; v < clean.rows; ++v) {
    const auto* row = clean.ptr<std::uint8_t>(v);
    int first = 0, last = clean.cols - 1;
    while (first <= last && row[first] == 0) ++first;
    while (last > first && row[last] == 0) --last;
    if (first > last) continue;
    // a pixel reaches half a pixel up, down and to each side; at slanting edges its centre is what tells
    const auto left = static_cast<float>(first), right = static_cast<float>(last), y = static_cast<float>(v);
    for (const float side : {-0.5F, 0.5F}) corners.insert(corners.end(), {{left, y + side}, {right, y + side}});
    corners.insert(corners.end(), {{left - 0.5F, y}, {right + 0.5F, y}});
  }
  if (corners.empty()) return {};
  cv::convexHull(corners, hull);
  std::vector<Vec2> outline;
  for (const cv::Point2f& p : hull) outline.push_back({p.x - margin, p.y - margin});
  return outline;
}

double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace unseen::collision
