// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kThin = 0.5;     // of the shorter other side: a thinner box may have been seen from one side only
constexpr double kUpright = 0.3;  // cosine: such an axis is horizontal

}  // namespace

void assume_thickness(const DepthView& view, Rooms& rooms, Problem& problem) {
  std::vector<ConvexSolid> solids;
  for (const Cuboid& cuboid : problem.cuboids) solids.push_back(solid_of(cuboid.initial));
  for (std::size_t i = 0; i < problem.cuboids.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      OrientedBox& box = problem.cuboids[i].initial;
      const double size = 2.0 * box.half_size[axis];
      const double depth = 2.0 * std::min(box.half_size[(axis + 1) % 3], box.half_size[(axis + 2) % 3]);
      if (std::abs(box.axes(2, axis)) > kUpright || size > kThin * depth) continue;
      const int face = rooms[i][2 * axis] > rooms[i][2 * axis + 1] ? 2 * axis : 2 * axis + 1;
      if (rooms[i][face] < kHiddenRoom * problem.tolerance[i]) continue;
      if (!is_covered(view, box, face, 4.0 * problem.tolerance[i], problem.tolerance[i])) continue;
      double length = std::min(depth - size, rooms[i][face]);
      for (std::size_t j = 0; j < solids.size(); ++j)
        if (const auto gap = i == j ? std::nullopt : reach(box, face, solids[j], problem.tolerance[i])) length = std::min(length, *gap);
      for (const Support& support : problem.supports)
        if (const auto gap = reach(box, face, support)) length = std::min(length, *gap);
      if (length <= 0.0) continue;
      box = extended(box, face, length);
      solids[i] = solid_of(box);
      rooms[i][face] -= length;
    }
}

}  // namespace unseen::cuboids
