// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// A block of cells, from `low` to before `high`.
struct CellBlock {
  std::array<int, 3> low{}, high{};
  int cells() const { return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]); }
};

/// Cells of a box, x fastest.
struct CellGrid {
  std::array<int, 3> size{};
  std::vector<char> cells;
  std::size_t at(int x, int y, int z) const { return (static_cast<std::size_t>(z) * size[1] + y) * size[0] + x; }
};

/// Blocks that do not overlap, each filled by at least the share `fill` (thesis, Section 4.3.1): in turn the block that
/// holds most filled cells above that share, until it holds fewer than `least` cells of the filled ones.
std::vector<CellBlock> greedy_slabs(const CellGrid& filled, double fill, int least);

/// Up-aligned boxes of an object that was scanned from all sides and stands upright (z up). All share one yaw, that of
/// the smallest rectangle around its plan. A place is filled if it holds points, or if points lie to its four sides
/// and above it: scans have no bottom.
std::vector<OrientedBox> fit_model_boxes(const std::vector<Vec3>& points, double fill);

/// Yaw in [0, π/2) of the rectangle of least area around the plan of the points.
double plan_yaw(const std::vector<Vec3>& points);

}  // namespace unseen::cuboids
