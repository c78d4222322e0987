// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"

namespace unseen::interactions {

/// Everything that `reconstruct` can be told. The defaults are meant to work.
struct Options {
  bool occlusion = true;     ///< joints that are not seen should be hidden by something
  bool smoothness = true;    ///< the pelvis does not jump
  bool intersection = true;  ///< objects do not overlap, and nobody walks through them
  bool saliency = true;      ///< windows by interaction saliency; false: by how well motions match
  bool evidence = true;      ///< the evidence map prices objects
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(Options& options);

}  // namespace unseen::interactions
