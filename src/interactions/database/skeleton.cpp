// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/skeleton.h"

#include <cmath>

namespace unseen::interactions {

Vec3 facing(const Pose& pose) {
  const Vec3 right = pose.col(right_hip) - pose.col(left_hip) + pose.col(right_shoulder) - pose.col(left_shoulder);
  const Vec3 forward(-right.y(), right.x(), 0.0);
  const double length = forward.norm();
  return length > 1e-9 ? Vec3(forward / length) : Vec3::UnitY();
}

namespace {
Mat3 about_up(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(); }
}  // namespace

Vec3 Placement::operator*(const Vec3& p) const { return about_up(angle) * p + position; }
Pose Placement::operator*(const Pose& pose) const { return (about_up(angle) * pose).colwise() + position; }
Placement Placement::operator*(const Placement& o) const { return {*this * o.position, angle + o.angle}; }
OrientedBox Placement::operator*(const OrientedBox& box) const { return {*this * box.center, about_up(angle) * box.axes, box.half_size}; }
Placement Placement::inverse() const { return {-(about_up(-angle) * position), -angle}; }

Placement frame_of(const Pose& pose) {
  const Vec3 forward = facing(pose), origin = pose.col(pelvis);
  return {{origin.x(), origin.y(), 0.0}, std::atan2(-forward.x(), forward.y())};
}

}  // namespace unseen::interactions
