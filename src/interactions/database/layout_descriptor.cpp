// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/database/footprint.h"
#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {
namespace {

Polygon bin(int row, int column) {
  const Vec2 low((column - kGrid / 2.0) * kBin, (row - kGrid / 2.0) * kBin);
  return {low, low + Vec2(kBin, 0), low + Vec2(kBin, kBin), low + Vec2(0, kBin)};
}

double total_area(const std::vector<Polygon>& pieces) {
  double sum = 0;
  for (const Polygon& piece : pieces) sum += area(piece);
  return sum;
}

double area_within(const std::vector<Polygon>& pieces, const Polygon& frame) {
  double sum = 0;
  for (const Polygon& piece : pieces) sum += area(intersection(piece, frame));
  return sum;
}

}  // namespace

std::vector<float> layout_descriptor(const std::vector<Object>& objects) {
  std::vector<float> layout(kCategories.size() * kGrid * kGrid, 0.0f);
  for (const Object& object : objects) {
    const std::vector<Polygon> pieces = footprint(object);
    const double smaller = std::min(total_area(pieces), kBin * kBin);
    if (!(smaller > 0)) continue;
    float* grid = &layout[static_cast<std::size_t>(category_index(object.category)) * kGrid * kGrid];
    for (int row = 0; row < kGrid; ++row)
      for (int column = 0; column < kGrid; ++column, ++grid)
        *grid = std::max(*grid, static_cast<float>(std::min(area_within(pieces, bin(row, column)) / smaller, 1.0)));
  }
  return layout;
}

}  // namespace unseen::interactions
