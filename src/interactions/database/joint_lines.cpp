// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Geometry>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {
namespace {

struct JointLine {
  Joint joint, from, to;
};

/// The thesis leaves the choice to Zhang et al.; these follow limbs' bending, reach, crouching and stride.
constexpr std::array<JointLine, kJointLines> kLines = {{{right_knee, right_hip, right_ankle}, {left_knee, left_hip, left_ankle},
                                                        {right_elbow, right_shoulder, right_wrist}, {left_elbow, left_shoulder, left_wrist},
                                                        {right_hip, right_shoulder, right_knee}, {left_hip, left_shoulder, left_knee},
                                                        {right_knee, pelvis, thorax}, {left_knee, pelvis, thorax},
                                                        {right_ankle, pelvis, thorax}, {left_ankle, pelvis, thorax},
                                                        {right_wrist, pelvis, thorax}, {left_wrist, pelvis, thorax},
                                                        {head, pelvis, thorax}, {pelvis, right_ankle, left_ankle}}};

double distance(const Vec3& joint, const Vec3& from, const Vec3& to) {
  const Vec3 line = to - from;
  const double length = line.norm();
  return length > 1e-9 ? (joint - from).cross(line).norm() / length : (joint - from).norm();
}

}  // namespace

Eigen::Matrix<double, kJointLines, 1> joint_line_distances(const Pose& pose) {
  Eigen::Matrix<double, kJointLines, 1> d;
  for (int i = 0; i < kJointLines; ++i) {
    const JointLine& line = kLines[static_cast<std::size_t>(i)];
    d[i] = distance(pose.col(line.joint), pose.col(line.from), pose.col(line.to));
  }
  return d;
}

}  // namespace unseen::interactions
