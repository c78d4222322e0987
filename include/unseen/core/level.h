// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/geometry.h"

namespace unseen {

/// The rotation from camera to world if `up` (unit, camera coordinates) is up: y along the camera's forward direction, or along the
/// image's up if that is within 5° of the vertical.
inline Mat3 level_rotation(const Vec3& up) {
  Vec3 forward = Vec3::UnitZ();
  if (line_angle(forward, up) < radians(5.0)) forward = -Vec3::UnitY();
  const Vec3 y = (forward - forward.dot(up) * up).normalized();
  Mat3 rotation;
  rotation << y.cross(up).transpose(), y.transpose(), up.transpose();
  return rotation;
}

}  // namespace unseen
