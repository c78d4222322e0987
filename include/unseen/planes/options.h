// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/core/options.h"

namespace unseen::planes {

/// Everything that `find_planes` can be told. The defaults are meant to work; scale and angles are what a
/// user may know better. Angles are in degrees here, as in files and on the command line.
struct Options {
  std::optional<double> scale;           ///< ρ, m: what is larger is kept; also the measurement tolerance
  std::optional<double> relative_scale;  ///< ρ as a share of the longest edge of the bounding box; instead of scale
  std::vector<double> angles = {90.0};   ///< deg, generators of Θ (thesis Section 3.4)
  double lambda = 0.5;                   ///< λ, Eq. 3.1: 1 keeps every local fit, 0 asks for one frame
  double patch_angle = 15.0;             ///< deg, τ: how far a normal may turn within a patch, and a candidate from its patch
  std::string solver = "local";          ///< selection: "local" or "exact" (CBC)
  double time_limit = 60.0;              ///< s, for the exact solver
  bool adaptive_scale = false;           ///< ρ grows with the distance to the viewpoint, or with local noise
  std::vector<double> viewpoint;         ///< m, where the sensor stood: x,y,z; empty = as the file says
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(Options& options);

}  // namespace unseen::planes
