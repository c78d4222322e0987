// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "interactions/ground/upright.h"

namespace unseen::interactions {

/// The lower ankle of someone upright: how far below the camera's axis it is seen (a tangent), and the
/// inverse of its depth by the length of the body, 1/m.
struct Foot {
  double below, inverse_depth;
  int person;
};

/// Those of all detections that have a person; `roll` (rad) is the camera's.
std::vector<Foot> lower_feet(const Take& take, double roll);

/// What cameras are like before anybody is seen: means and standard deviations.
struct UsualCamera {
  double height = 1.3, height_sd = 0.4;  ///< m, above ankles, of cameras that film people
  double slope = 0.06, slope_sd = 0.06;  ///< tangent of the pitch: most are nearly level
};

struct LevelFloor {
  double height = 0, slope = 0;  ///< m above ankles, along the picture's vertical; tangent of the pitch
  Eigen::Matrix2d information;   ///< of both
};

/// The floor under feet whose depths are told by the length of bodies as if they stood across the view, which
/// holds if the camera is nearly level or its tilt is known. How tall each of the `people` is, is unknown.
/// `fps`: frames per second.
LevelFloor level_floor(const std::vector<Foot>& feet, int people, const UsualCamera& usual, double fps);

}  // namespace unseen::interactions
