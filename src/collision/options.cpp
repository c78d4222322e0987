// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/options.h"

namespace unseen::collision {

OptionTable describe(Options& o) {
  OptionTable t;
  t.add({"physics", &o.physics, "", "exact: impulse and momentum hold to rounding; soft: as residuals with the thesis's weights", 0, 0, {"exact", "soft"}});
  t.add({"without", &o.without, "", "terms left out, separated by commas, for ablations: momentum, impulse, energy, restitution, gravity, size, orientation"});
  t.add({"friction", &o.friction, "", "the impulse may have a part across the normal; false takes it to lie along the normal", 0, 1, {}});
  t.add({"drag", &o.drag, "", "quadratic drag of the air: from mass and size (on), or estimated from the flights", 0, 0, {"off", "on", "estimate"}});
  t.add({"drag_coefficient", &o.drag_coefficient, "1", "Cd, 0.47 for a sphere", 0.0, 10.0, {}});
  t.add({"fix_mass_ratio", &o.fix_mass_ratio, "", "take the mass ratio from the bodies' masses", 0, 1, {}});
  t.add({"shared_restitution", &o.shared_restitution, "", "all impacts of the shot have one restitution", 0, 1, {}});
  t.add({"starts", &o.starts, "", "how many starts are solved; the best is kept, others that explain the data alike are told", 1, 1000, {}});
  t.add({"resamples", &o.resamples, "", "of the residuals, for the intervals; 0 = from the covariance alone", 0, 10000, {}});
  t.add({"held_out", &o.held_out, "", "every so manyth sighting of a flight is kept out of a second solve that tells whether the model fits; 0 = none", 0, 1000, {}});
  t.add({"orientation_noise", &o.orientation_noise, "deg", "standard deviation of given orientations", 0.01, 180.0, {}});
  t.add({"seed", &o.seed, "", "of random choices", 0, 2147483647, {}});
  return t;
}

}  // namespace unseen::collision
