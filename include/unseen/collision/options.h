// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"

namespace unseen::collision {

/// Everything that `reconstruct` can be told. The defaults are meant to work.
struct Options {
  std::string physics = "exact";  ///< exact | soft (the thesis's residuals and weights)
  std::string without;            ///< terms left out, separated by commas: for ablations
  bool friction = true;           ///< false: the impulse is taken to lie along the normal
  std::string drag = "off";       ///< off | on (from mass and size) | estimate
  double drag_coefficient = 0.47;  ///< Cd
  bool fix_mass_ratio = false;     ///< the bodies' masses give the mass ratio
  bool shared_restitution = false;  ///< all impacts of a shot have one restitution
  int starts = 16;                  ///< solutions tried from different starts
  int resamples = 40;               ///< of the residuals, for the intervals
  int held_out = 5;                 ///< every so manyth frame is kept out of a second solve that tells whether the model fits; 0 = none
  double orientation_noise = 5.0;  ///< deg, standard deviation of given orientations
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(Options& options);

}  // namespace unseen::collision
