// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "interactions/synth/synth_room.h"

namespace unseen::interactions {

/// How far the floor is free, in cells of a grid.
struct FloorPlan {
  static constexpr double kCell = 0.1;  ///< m
  Vec2 origin = Vec2::Zero();           ///< of the first cell's middle
  int columns = 0, rows = 0;
  std::vector<double> clearance;  ///< m, to the nearest furniture or end of the floor; row by row

  double at(const Vec2& p) const;  ///< of the nearest cell; 0 outside
  Vec2 middle(int cell) const { return origin + kCell * Vec2(cell % columns, cell / columns); }
};
FloorPlan plan_floor(const Room& room);

/// A smooth path that keeps clear of furniture, as points about 5 cm apart; none if there is no way. Ends may be close to furniture:
/// there the way leads straight to the nearest free place.
std::optional<std::vector<Vec2>> find_path(const FloorPlan& plan, const Vec2& from, const Vec2& to);

}  // namespace unseen::interactions
