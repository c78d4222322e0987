// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>

#include "interactions/matching/reading.h"

namespace unseen::interactions {

/// Where a pelvis is on the ground in every frame from `first` on.
struct Path {
  int first = 0;
  std::vector<Vec2> positions;

  int last() const { return first + static_cast<int>(positions.size()) - 1; }
  const Vec2& at(int frame) const { return positions[static_cast<std::size_t>(std::clamp(frame - first, 0, static_cast<int>(positions.size()) - 1))]; }
};

/// The path of least squares: near the readings, whose depth along the view is far less certain than their direction, and from frame to frame
/// moving as the matched scenelets move: who sits stays, who sits down steps back half a metre. `smooth` false: readings alone.
Path find_path(const std::vector<Reading>& readings, const Database& database, const View& view, double fps, int first, int last, bool smooth);

}  // namespace unseen::interactions
