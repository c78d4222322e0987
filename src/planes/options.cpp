// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/options.h"

namespace unseen::planes {

OptionTable describe(Options& o) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kTiny = std::numeric_limits<double>::min();
  OptionTable table;
  table.add({"scale", &o.scale, "m", "structures larger than this are kept (narrow strips from 2.7 times it); also the measurement tolerance. Without it, it is estimated from spacing and noise", kTiny, kInf, {}});
  table.add({"relative_scale", &o.relative_scale, "1", "scale as a share of the longest edge of the bounding box", kTiny, 1.0, {}});
  table.add({"angles", &o.angles, "deg", "angles that the scene repeats; multiples below 180° are meant too", 1.0, 180.0, {}});
  table.add({"lambda", &o.lambda, "1", "1 keeps every local fit, 0 asks for one orientation frame", 0.0, 1.0, {}});
  table.add({"patch_angle", &o.patch_angle, "deg", "how far a normal may turn within a patch, and a candidate from its patch", 1.0, 45.0, {}});
  table.add({"solver", &o.solver, "", "how frames are selected; exact proves small problems by integer programming", -kInf, kInf, {"local", "exact"}});
  table.add({"time_limit", &o.time_limit, "s", "for the exact solver", 0.0, kInf, {}});
  table.add({"adaptive_scale", &o.adaptive_scale, "", "let the scale grow with the distance to the viewpoint, or with the local noise", -kInf, kInf, {}});
  table.add({"viewpoint", &o.viewpoint, "m", "where the sensor stood: x,y,z. Without it, what the file says", -kInf, kInf, {}, {"x", "y", "z"}});
  table.add({"seed", &o.seed, "", "seed of everything random", 0, 2147483647, {}});
  return table;
}

}  // namespace unseen::planes
