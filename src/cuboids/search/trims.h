// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cuboids/search/problem.h"
#include "cuboids/surfaces/depth_view.h"
#include "unseen/core/context.h"
#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// Whether a box lies nearly all within another one, which explains nearly all that was measured there too. The tolerances (m) are how far off measured points
/// still are of a box.
bool is_contained(const DepthView& view, const OrientedBox& inner, double tolerance, const OrientedBox& outer, double outer_tolerance);

/// A face of a box that moves inward.
struct Trim {
  int cuboid = -1, face = -1;
  double length = 0;  ///< m
};

/// The trims of one face that end the overlap of two of the boxes, best first: they leave few of the measured points in no box; of those that leave hardly
/// any, those come first by which least is lost that is not in both. Not those that leave more than a tenth of the points of the box that is trimmed.
/// `tolerance` (m, a box) is how far off measured points still are of a box.
std::vector<Trim> trims_of(const DepthView& view, const std::vector<OrientedBox>& boxes, const std::vector<double>& tolerance, std::array<int, 2> pair);

/// What the end of a run knows of its bodies.
struct Ending {
  Problem problem;
  std::vector<char> held, falls;  ///< a body
  Arrangement arrangement;
  std::vector<Cuboid> cuboids;  ///< with their boxes as fitted
};
/// Takes away pieces that are contained in another box of their rigid body, unless masks tell the two apart, or the whole would bear less without them: the
/// inside of a cup.
void drop_contained(const DepthView& view, Ending& ending);

/// Boxes of one rigid body that still overlap at the end: one face of either moves inward, if other boxes explain nearly all that was measured there, what touched
/// still touches, and the whole bears as much (where weights that were counted twice had kept it so, it may be held by a neighbour).
/// Returns what then falls, where that was looked at anew.
std::optional<std::vector<char>> trim_overlaps(const DepthView& view, const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context);

}  // namespace unseen::cuboids
