// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::planes {

/// Cells, full (1) or empty (0).
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cells;

  std::uint8_t& at(int x, int y) { return cells[static_cast<std::size_t>(y) * width + x]; }
  bool full(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && cells[static_cast<std::size_t>(y) * width + x] != 0;
  }
};

/// Marks the cells in which points lie, with `margin` empty cells around all.
Raster rasterize(const std::vector<Vec2>& points, const Vec2& low, const Vec2& high, double cell, int margin);

/// Full cells and all within `radius` of them along both axes.
Raster dilated(const Raster& r, int radius);

/// Fills gaps of up to twice `radius` between full cells.
Raster closed(const Raster& r, int radius);

/// Keeps the largest part connected by edges. Cells at the raster's border are empty.
void keep_largest(Raster& r);

/// How many cells are full in any rectangle, by sums from the first corner.
class Counts {
 public:
  explicit Counts(const Raster& r) : width_(r.width), height_(r.height), sums_(static_cast<std::size_t>(r.width + 1) * (r.height + 1), 0) {
    for (int y = 0; y < r.height; ++y)
      for (int x = 0, row = 0; x < r.width; ++x) {
        row += r.cells[static_cast<std::size_t>(y) * r.width + x];
        sum(x + 1, y + 1) = sum(x + 1, y) + row;
      }
  }
  /// Within `reach` of a cell along both axes.
  int around(int x, int y, int reach) const {
    const int x0 = std::max(0, x - reach), y0 = std::max(0, y - reach), x1 = std::min(width_, x + reach + 1), y1 = std::min(height_, y + reach + 1);
    return sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0);
  }

 private:
  int& sum(int x, int y) { return sums_[static_cast<std::size_t>(y) * (width_ + 1) + x]; }
  int sum(int x, int y) const { return sums_[static_cast<std::size_t>(y) * (width_ + 1) + x]; }

  int width_, height_;
  std::vector<int> sums_;
};

}  // namespace unseen::planes
