// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/database/motion_descriptor.h"

#include <algorithm>
#include <cmath>

#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

/// A pose as a point of the 17-D space in which a motion is a curve: distances, then the pelvis. m
using Point = Eigen::Matrix<double, kJointLines + 3, 1>;

Point point_of(const Pose& pose) {
  Point p;
  p << joint_line_distances(pose), pose.col(pelvis);
  return p;
}

constexpr double kMiddle = (kDescriptorPoses - 1) / 2.0;
constexpr double kWeightSpread = kDescriptorPoses / 4.0;  ///< samples; the ends weigh a sixth of the middle

}  // namespace

Eigen::Matrix<float, kDescriptorPoses, 1> pose_weights() {
  Eigen::Matrix<double, kDescriptorPoses, 1> w;
  for (int i = 0; i < kDescriptorPoses; ++i) w[i] = std::exp(-0.5 * std::pow((i - kMiddle) / kWeightSpread, 2));
  return (w / w.sum()).cast<float>();
}

Eigen::Matrix<float, kJointLines, kDescriptorPoses> motion_descriptor(const std::vector<Pose>& poses) {
  if (poses.empty()) throw InputError("motion", "poses", "none", "at least one");
  std::vector<Point> points;
  std::vector<double> length;  // of the curve up to each point
  for (const Pose& pose : poses) {
    points.push_back(point_of(pose));
    length.push_back(length.empty() ? 0.0 : length.back() + (points.back() - points[points.size() - 2]).norm());
  }
  Eigen::Matrix<float, kJointLines, kDescriptorPoses> motion;
  std::size_t after = 0;
  for (int i = 0; i < kDescriptorPoses; ++i) {
    const double at = length.back() * i / (kDescriptorPoses - 1);
    while (after + 1 < points.size() && length[after] < at) ++after;
    const std::size_t before = after > 0 ? after - 1 : 0;
    const double gap = length[after] - length[before];
    const double share = gap > 0 ? std::clamp((at - length[before]) / gap, 0.0, 1.0) : 0.0;
    motion.col(i) = (points[before] + share * (points[after] - points[before])).head<kJointLines>().cast<float>();
  }
  return motion;
}

double motion_distance(const Eigen::Matrix<float, kJointLines, kDescriptorPoses>& a, const Eigen::Matrix<float, kJointLines, kDescriptorPoses>& b) {
  return std::sqrt(static_cast<double>((a - b).colwise().squaredNorm().dot(pose_weights())));
}

}  // namespace unseen::interactions
