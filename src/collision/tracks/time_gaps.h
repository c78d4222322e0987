// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/tracks/candidates.h"
#include "collision/tracks/spans.h"

namespace unseen::collision {

/// Frames that a clip has lost behind even time stamps.
struct TimeGaps {
  struct Gap {
    int after = 0;    ///< last frame before the gap
    int missing = 1;  ///< frames
  };
  std::vector<Gap> gaps;
  std::optional<int> period;  ///< every so many frames one is missing: the clip was thinned to a lower rate, its average rate is right

  /// Time of a frame in frame times, from its nominal time.
  double corrected(int frame, double u) const;
};

/// Looks for places within flights of one body where one parabola fits both sides only if one or two frames are put between them.
/// With the image's gravity fewer points will do.
TimeGaps find_time_gaps(const std::vector<Candidate>& track, double noise, const std::optional<ImageGravity>& gravity);

}  // namespace unseen::collision
