// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/appearance.h"
#include "collision/orientations/spin_search.h"
#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// One flight of a body and the motions that explain what is seen of it.
struct SpinFlight {
  int span = 0;                     ///< index into Tracks::spans
  std::vector<Look> looks;
  std::vector<Turning> turnings;
  std::vector<double> costs;        ///< χ², one a turning
  std::vector<Quat> alike;          ///< member of the body's symmetries that makes a turning go on from the flight before
  double noise = 1;                 ///< of silhouettes, in units of what was expected
};

/// Ties the flights of one body, in time order, at the impacts between them: an impact leaves the orientation as it is, and faces keep
/// their colours. Fills in `alike`, and lets `costs` become those of the best choice for all other flights (min-sum over the chain).
void join_flights(const std::vector<SpinFlight*>& flights, const SpinBody& body, const std::vector<SurfacePoint>& points,
                  const Camera& camera, const Tracks& tracks, double fps);

}  // namespace unseen::collision
