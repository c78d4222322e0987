// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <limits>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

OptionTable describe(SceneletOptions& o) {
  constexpr double kAboveZero = std::numeric_limits<double>::min();
  OptionTable t;
  t.add({"arc_length", &o.arc_length, "m", "of the pelvis' path that a scenelet covers", kAboveZero, 10, {}});
  t.add({"step", &o.step, "m", "of path from one scenelet to the next", kAboveZero, 10, {}});
  t.add({"longest", &o.longest, "s", "a scenelet lasts; who sits still covers no path", 0.1, 10, {}});
  t.add({"reach", &o.reach, "m", "objects within it of the path belong to a scenelet", 0, 10, {}});
  t.add({"motion_sigma", &o.motion_sigma, "m", "how far apart similar motions are, for the saliency", kAboveZero, 10, {}});
  return t;
}

}  // namespace unseen::interactions
