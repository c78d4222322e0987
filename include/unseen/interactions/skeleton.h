// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <array>

#include "unseen/core/geometry.h"

namespace unseen::interactions {

inline constexpr int kJoints = 16;

/// The joints, in the order of every array and file of this capability.
enum Joint {
  right_ankle, right_knee, right_hip, left_hip, left_knee, left_ankle, pelvis, thorax,
  neck, head, right_wrist, right_elbow, right_shoulder, left_shoulder, left_elbow, left_wrist
};
inline constexpr std::array<const char*, kJoints> kJointNames = {
    "right ankle", "right knee", "right hip", "left hip", "left knee", "left ankle", "pelvis", "thorax",
    "neck", "head", "right wrist", "right elbow", "right shoulder", "left shoulder", "left elbow", "left wrist"};

/// The bones as pairs (parent, child), from the pelvis outwards.
inline constexpr std::array<std::array<Joint, 2>, 15> kBones = {{{pelvis, right_hip}, {right_hip, right_knee}, {right_knee, right_ankle},
                                                                 {pelvis, left_hip}, {left_hip, left_knee}, {left_knee, left_ankle},
                                                                 {pelvis, thorax}, {thorax, neck}, {neck, head},
                                                                 {thorax, right_shoulder}, {right_shoulder, right_elbow}, {right_elbow, right_wrist},
                                                                 {thorax, left_shoulder}, {left_shoulder, left_elbow}, {left_elbow, left_wrist}}};

using Pose = Eigen::Matrix<double, 3, kJoints>;    ///< a column a joint, m
using Pixels = Eigen::Matrix<double, 2, kJoints>;  ///< a column a joint, px
using PerJoint = Eigen::Array<double, kJoints, 1>;

/// Where a pose faces: unit, in the ground plane (z up); across hips and shoulders. +y if it cannot be told.
Vec3 facing(const Pose& pose);

/// Position on the ground, height and heading of something: `angle` (rad) turns about up, counter-clockwise seen from above.
struct Placement {
  Vec3 position = Vec3::Zero();
  double angle = 0;

  Vec3 operator*(const Vec3& p) const;
  Pose operator*(const Pose& pose) const;
  Placement operator*(const Placement& o) const;
  OrientedBox operator*(const OrientedBox& box) const;
  Placement inverse() const;
};

/// The frame of a pose: origin at its pelvis, +y where it faces.
Placement frame_of(const Pose& pose);

}  // namespace unseen::interactions
