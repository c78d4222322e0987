// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/options.h"

#include <limits>

namespace unseen::cuboids {

OptionTable describe(Options& o) {
  constexpr double kTiny = std::numeric_limits<double>::min();
  OptionTable t;
  t.add({"friction", &o.friction, "1", "friction coefficient of all contacts", 0.0, 10.0, {}});
  t.add({"density", &o.density, "kg/m³", "density of what the frame names none for", kTiny, 1e5, {}});
  t.add({"noise", &o.noise, "m", "standard deviation of the depth at 1 m; it grows with the square of the depth (default: as in flat patches of the frame, at most 0.0015, a Kinect's, or 0.004 where errors of neighbours are alike)", kTiny, 0.1, {}});
  t.add({"gap", &o.gap, "m", "parts of one object are at most this far apart (default: from noise and pixel spacing)", kTiny, 1.0, {}});
  t.add({"fill", &o.fill, "1", "share of a box that must be surface or hidden", 0.1, 1.0, {}});
  t.add({"stable_residual", &o.stable_residual, "1", "an arrangement with a smaller residual stands; --check decides exactly", 1e-9, 1.0, {}});
  t.add({"push", &o.push, "g", "horizontal acceleration that the scene must bear from any side, so that it stands clearly; 0 asks for balance alone", 0.0, 1.0, {}});
  t.add({"strokes", &o.strokes, "", "how strokes part what touches: along the surface from the nearest one, or by grab-cut of the picture", 0, 1, {"surface", "grab-cut"}});
  t.add({"image_edges", &o.image_edges, "", "pull visible box edges to edges of the colour image", 0, 1, {}});
  t.add({"arrangements", &o.arrangements, "", "how many arrangements the search looks at for each part of the scene; the best found by then is kept", 1, 1e9, {}});
  t.add({"time_limit", &o.time_limit, "s", "for the search; the best arrangement found by then is kept", 0.01, 3600.0, {}});
  t.add({"seed", &o.seed, "", "of random choices", 0, 2147483647, {}});
  return t;
}

}  // namespace unseen::cuboids
