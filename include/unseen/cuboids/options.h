// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/core/options.h"

namespace unseen::cuboids {

/// Everything that `complete_cuboids` can be told. The defaults are meant to work.
struct Options {
  double friction = 0.7;           ///< μ
  double density = 300.0;          ///< kg/m³, where the frame names none
  std::optional<double> noise;     ///< σ of the depth at 1 m, m; grows with the square of the depth; unset = measured, at most 0.0015
  std::optional<double> gap;       ///< m, between parts of one object; unset = from noise and pixel spacing
  double fill = 0.7;               ///< share of filled voxels in a slab
  double stable_residual = 0.02;   ///< an arrangement with a smaller residual stands
  double push = 0.1;               ///< g: what stands must bear this horizontal acceleration too; 0 = balance alone
  std::string strokes = "surface"; ///< how strokes part what touches: along the "surface", or by "grab-cut" of the picture
  bool image_edges = true;         ///< pull visible box edges to edges of the colour image
  int arrangements = 3000;         ///< looked at by the search for each part of the scene (fewer for parts of more than 8 boxes)
  double time_limit = 10.0;        ///< s, for the search; what is best then is kept
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(Options& options);

}  // namespace unseen::cuboids
