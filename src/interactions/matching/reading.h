// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/matching/matching.h"
#include "unseen/interactions/options.h"

namespace unseen::interactions {

/// What the scenelets that fit the frames around one frame say together.
struct Reading {
  int frame = 0;
  Glance glance;
  std::vector<Match> matches;   ///< best first
  std::vector<double> weights;  ///< of the matches, sum 1
  double likelihood = 0;        ///< of an interaction: weighted interaction saliency (thesis Section 6.4.2)

  /// Ground position of the pelvis, and its covariance over the matches.
  Vec2 pelvis = Vec2::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
};

/// A reading every 0.2 s. With `occlusion`, joints that are not seen speak for scenelets whose objects hide them.
std::vector<Reading> read_motion(const std::vector<Sight>& sights, const Database& database, const View& view,
                                 double fps, bool occlusion, const Context& context);

}  // namespace unseen::interactions
