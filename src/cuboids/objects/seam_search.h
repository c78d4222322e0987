// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/objects/seam_lines.h"

namespace unseen::cuboids {

/// A part of what was seen, and the picture of it.
struct PicturedPart {
  const GreyPicture& picture;
  const Camera& camera;
  const Observation& seen;
  Directions directions;
  std::vector<int> points;
  bool carries = false;  ///< another piece stands on it, which may hide its top
};

/// Planes across one of the directions, along which the picture shows seams over the whole part.
struct Seams {
  std::vector<double> at;  ///< m, in order
  double shown = 0;        ///< 0 … 1: on how much of their lines, in the mean
};

/// Those across direction `axis` (0 and 1 horizontal, 2 up).
Seams seams_across(const PicturedPart& part, int axis);

}  // namespace unseen::cuboids
