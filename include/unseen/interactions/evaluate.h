// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

struct ObjectScore {
  int truth = -1, found = -1;  ///< ids; −1: nothing found, or a false object
  std::string category;        ///< the true one's, of a false object its own
  Superclass superclass = Superclass::other;
  bool interacted = true;
  std::optional<double> distance;  ///< m on the ground, of main parts
};

struct PoseScore {
  int frames = 0;
  int interpolated = 0;  ///< of them, those that the result lacks: taken between its nearest frames
  double local = 0;  ///< m, mean over joints, then frames; pelvis at the origin
  double world = 0;  ///< share of the ground diagonal of all true joints
};

struct Evaluation {
  std::vector<ObjectScore> objects;
  int interacted = 0, found = 0, false_objects = 0;
  std::optional<double> mean_distance, sd_distance, median_distance;  ///< m, of the interacted objects found
  std::optional<PoseScore> occluded, all;
  double action_accuracy = 0;
  std::vector<std::vector<int>> confusion;  ///< [true][found] frames: sit, stand up, walk, reach
  double inside_objects = 0;       ///< share of frames with the pelvis deeper than 5 cm in a box
  double true_inside_objects = 0;  ///< the same of the truth in its own boxes
  double foot_skating = 0;         ///< m/s, mean ground speed of ankles below 0.15 m
  double overlapping = 0;          ///< m², of footprints of different objects
  std::optional<double> identity;  ///< share of the frames with a true person in sight in which he is the right one of the result
};

/// Result against truth, by the rules of docs/interactions.md (gate 1.5 m, one-to-one, superclass must agree).
Evaluation evaluate(const Reconstruction& result, const Recording& truth);

}  // namespace unseen::interactions
