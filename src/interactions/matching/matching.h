// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "interactions/ground/sight.h"
#include "interactions/matching/placement_fit.h"
#include "unseen/core/context.h"
#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

/// A scenelet laid over the frames around one frame.
struct Match {
  int scenelet = -1;
  Placement placement;
  double error = 0;  ///< m² at the glance's depth: mean squared distance in the picture, weighted by confidence; robust once refined
};

/// Frames of one person around `center` that scenelets are laid over.
struct Glance {
  int center = 0;  ///< frame
  std::vector<const Sight*> sights;
  std::vector<double> offsets;  ///< s after the centre, one a sight
  double depth = 1;             ///< m, rough
};

/// The sights within `half` seconds of a frame, thinned to one in `step` seconds; where detections are sparse, those nearest to every step.
Glance glance_at(const std::vector<Sight>& sights, int frame, double fps, double half, double step);

/// The scenelet's pose some seconds after its middle, between recorded poses; nothing where it has none.
std::optional<Pose> pose_at(const Scenelet& scenelet, double offset);

/// Cost of the scenelet's placement over the glance, and the sum of its weights.
PlacementCost cost_of(const Glance& glance, const Scenelet& scenelet, const Vec3& camera, double& weight);

/// The `keep` scenelets that fit each glance best, best first, by the closed-form placement.
std::vector<std::vector<Match>> match_all(const std::vector<Glance>& glances, const Database& database, const Vec3& camera, std::size_t keep,
                                          const Context& context);

/// Damped Gauss–Newton on the robust distances in the picture, from the match's placement; updates placement and error.
void refine(Match& match, const Glance& glance, const Scenelet& scenelet, const View& view);

}  // namespace unseen::interactions
