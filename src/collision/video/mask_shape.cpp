// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/mask_shape.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::collision {

cv::Mat disc(int size) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size}); }

cv::Mat hull_of(const cv::Mat& mask) {
  std::vector<cv::Point> points, corners;
  cv::findNonZero(mask, points);
  cv::convexHull(points, corners);
  cv::Mat hull = cv::Mat::zeros(mask.size(), CV_8U);
  cv::fillConvexPoly(hull, corners, cv::Scalar(255));
  return hull;
}

double solidity(const cv::Mat& mask) {
  const int area = cv::countNonZero(mask);
  return area == 0 ? 0.0 : static_cast<double>(area) / cv::countNonZero(hull_of(mask));
}

double roundness(const cv::Mat& mask) {
  std::vector<cv::Point> points, hull;
  cv::Point2f center;
  float radius = 0.0F;
  cv::findNonZero(mask, points);
  if (points.empty()) return 0.0;
  cv::convexHull(points, hull);  // minEnclosingCircle takes minutes of all points of a large part
  cv::minEnclosingCircle(hull, center, radius);
  return static_cast<double>(points.size()) / (kPi * (radius + 0.5) * (radius + 0.5));
}

cv::Mat without_crumbs(const cv::Mat& mask) {
  constexpr double kCrumb = 0.1;
  cv::Mat labels, stats, centers, kept = cv::Mat::zeros(mask.size(), CV_8U);
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers, 4);
  int largest = 0;
  for (int i = 1; i < count; ++i) largest = std::max(largest, stats.at<int>(i, cv::CC_STAT_AREA));
  for (int i = 1; i < count; ++i)
    if (stats.at<int>(i, cv::CC_STAT_AREA) >= kCrumb * largest) kept.setTo(255, labels == i);
  return kept;
}

}  // namespace unseen::collision
