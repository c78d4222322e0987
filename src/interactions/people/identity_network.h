// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "interactions/people/identity_labels.h"

namespace unseen::interactions {

/// What everybody does: the detections of each path, by frame.
using Paths = std::vector<std::vector<int>>;

struct Link {
  int to;
  double cost;
};

struct Model {
  const Take& take;
  const Sightings& sightings;
  std::vector<std::vector<Link>> links;  ///< of each detection to those within memory
};
Model model_of(const Take& take, const Sightings& sightings);

/// Whether a label (or a choice of a search) says who is at a detection.
bool is_known(const Model& model, const Allowed& allowed, int detection);

/// The cheapest paths of all people through detections that known ones are not left out of; who comes first is the first. A step of a path
/// is somebody's, but the path as a whole need not be.
Paths cheapest_paths(const Model& model, const Allowed& allowed);

}  // namespace unseen::interactions
