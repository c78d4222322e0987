// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/cuboids/scan_completion.h"

namespace unseen::cuboids {

/// One-to-one matches of boxes of two arrangements that both stand on z = 0, by sizes and pairwise relations (Leordeanu
/// and Hebert, "A spectral technique for correspondence problems using pairwise constraints", 2005). A pair whose
/// horizontal edges all differ by more than 0.05 m in height or 0.1 m in length is none (thesis, Section 4.5 (i)).
struct SpectralMatch {
  std::vector<BoxMatch> matches;
  double score = 0;  ///< xᵀMx of the chosen matches
};
SpectralMatch match_boxes(const std::vector<OrientedBox>& model, const std::vector<OrientedBox>& scene);

/// Turns about up and moves on the ground that lay a horizontal edge of a model's box on one of its match, both ways.
std::vector<RigidTransform> alignments(const std::vector<OrientedBox>& model, const std::vector<OrientedBox>& scene,
                                       const std::vector<BoxMatch>& matches);

}  // namespace unseen::cuboids
