// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/options.h"

namespace unseen::interactions {

OptionTable describe(Options& o) {
  OptionTable t;
  t.add({"occlusion", &o.occlusion, "", "joints that are not seen should be hidden by something", 0, 1, {}});
  t.add({"smoothness", &o.smoothness, "", "the pelvis does not jump from one scenelet to the next", 0, 1, {}});
  t.add({"intersection", &o.intersection, "", "objects do not overlap, and nobody walks through them", 0, 1, {}});
  t.add({"saliency", &o.saliency, "", "windows are chosen by interaction saliency; false: by how well motions match alone", 0, 1, {}});
  t.add({"evidence", &o.evidence, "", "the evidence of all good matches prices an object", 0, 1, {}});
  t.add({"seed", &o.seed, "", "of random choices", 0, 2147483647, {}});
  return t;
}

}  // namespace unseen::interactions
