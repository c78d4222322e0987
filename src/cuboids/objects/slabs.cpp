// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/slabs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr int kMostCells = 14;          // an axis; (14 · 15 / 2)³ candidates
constexpr double kSmallestSlab = 0.1;  // of the points of the whole
constexpr std::size_t kFewestSlabPoints = 100;
constexpr double kLeastGain = 0.05;
constexpr int kMostSlabs = 12;

using Index3 = std::array<int, 3>;

/// Cells of a box: how many are there, which is filled, and how many points each holds.
struct Cells {
  Index3 count;
  std::vector<int> filled, points;

  std::size_t at(int x, int y, int z) const { return (static_cast<std::size_t>(z) * count[1] + y) * count[0] + x; }
};

/// Sums over all cells below and left of each corner.
std::vector<int> integral(const Cells& cells, const std::vector<int>& values) {
  const int w = cells.count[0] + 1, h = cells.count[1] + 1;
  std::vector<int> sum(static_cast<std::size_t>(w) * h * (cells.count[2] + 1), 0);
  const auto s = [&](int x, int y, int z) -> int& { return sum[(static_cast<std::size_t>(z) * h + y) * w + x]; };
  for (int z = 1; z <= cells.count[2]; ++z)
    for (int y = 1; y < h; ++y)
      for (int x = 1; x < w; ++x)
        s(x, y, z) = values[cells.at(x - 1, y - 1, z - 1)] + s(x - 1, y, z) + s(x, y - 1, z) + s(x, y, z - 1) -
                     s(x - 1, y - 1, z) - s(x - 1, y, z - 1) - s(x, y - 1, z - 1) + s(x - 1, y - 1, z - 1);
  return sum;
}

struct Slab {
  Index3 from{}, to{};
  int points = 0;
};

/// The slab that explains most points while it is full: points count by how far it is above the least fill.
Slab best_slab(const Cells& cells, double fill) {
  const std::vector<int> filled = integral(cells, cells.filled), points = integral(cells, cells.points);
  const int w = cells.count[0] + 1, h = cells.count[1] + 1;
  const auto total = [&](const std::vector<int>& s, int x0, int y0, int z0, int x1, int y1, int z1) {
    const auto v = [&](int x, int y, int z) { return s[(static_cast<std::size_t>(z) * h + y) * w + x]; };
    return v(x1, y1, z1) - v(x0, y1, z1) - v(x1, y0, z1) - v(x1, y1, z0) + v(x0, y0, z1) + v(x0, y1, z0) + v(x1, y0, z0) - v(x0, y0, z0);
  };
  Slab best;
  double best_score = 0;
  for (int z0 = 0; z0 < cells.count[2]; ++z0)
    for (int z1 = z0 + 1; z1 <= cells.count[2]; ++z1)
      for (int y0 = 0; y0 < cells.count[1]; ++y0)
        for (int y1 = y0 + 1; y1 <= cells.count[1]; ++y1)
          for (int x0 = 0; x0 < cells.count[0]; ++x0)
            for (int x1 = x0 + 1; x1 <= cells.count[0]; ++x1) {
              const int p = total(points, x0, y0, z0, x1, y1, z1);
              if (p * (1.0 - fill + kLeastGain) <= best_score) continue;
              const int f = total(filled, x0, y0, z0, x1, y1, z1);
              const double share = static_cast<double>(f) / ((x1 - x0) * (y1 - y0) * (z1 - z0));
              const double score = p * (share - fill + kLeastGain);
              if (share < fill || score <= best_score) continue;
              best = {{x0, y0, z0}, {x1, y1, z1}, p};
              best_score = score;
            }
  return best;
}

}  // namespace

double filled_share(const DepthView& view, const OrientedBox& box, double voxel) {
  Index3 count;
  for (int k = 0; k < 3; ++k) count[k] = std::clamp(static_cast<int>(2.0 * box.half_size[k] / voxel), 1, kMostCells);
  int filled = 0;
  for (int x = 0; x < count[0]; ++x)
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z) {
        const Vec3 local((2.0 * x + 1.0) / count[0] - 1.0, (2.0 * y + 1.0) / count[1] - 1.0, (2.0 * z + 1.0) / count[2] - 1.0);
        filled += view.at(box.center + box.axes * local.cwiseProduct(box.half_size)) != DepthView::Space::free;
      }
  return static_cast<double>(filled) / (count[0] * count[1] * count[2]);
}

std::vector<std::vector<int>> split_into_slabs(const Observation& seen, const DepthView& view, std::span<const int> points,
                                               const OrientedBox& box, double voxel, double fill) {
  Cells cells;
  for (int k = 0; k < 3; ++k) cells.count[k] = std::clamp(static_cast<int>(2.0 * box.half_size[k] / voxel), 1, kMostCells);
  const std::size_t total = static_cast<std::size_t>(cells.count[0]) * cells.count[1] * cells.count[2];
  cells.filled.assign(total, 0);
  cells.points.assign(total, 0);
  for (int z = 0; z < cells.count[2]; ++z)
    for (int y = 0; y < cells.count[1]; ++y)
      for (int x = 0; x < cells.count[0]; ++x) {
        const Vec3 local((2.0 * x + 1.0) / cells.count[0] - 1.0, (2.0 * y + 1.0) / cells.count[1] - 1.0,
                         (2.0 * z + 1.0) / cells.count[2] - 1.0);
        cells.filled[cells.at(x, y, z)] = view.at(box.center + box.axes * local.cwiseProduct(box.half_size)) != DepthView::Space::free;
      }
  std::vector<std::size_t> cell_of(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 local = (box.axes.transpose() * (seen.points[points[k]] - box.center)).cwiseQuotient(box.half_size);
    Index3 c;
    for (int a = 0; a < 3; ++a) c[a] = std::clamp(static_cast<int>((local[a] + 1.0) * 0.5 * cells.count[a]), 0, cells.count[a] - 1);
    cell_of[k] = cells.at(c[0], c[1], c[2]);
    ++cells.points[cell_of[k]];
    cells.filled[cell_of[k]] = 1;
  }
  const std::size_t fewest = std::max(kFewestSlabPoints, static_cast<std::size_t>(kSmallestSlab * static_cast<double>(points.size())));
  std::vector<std::vector<int>> slabs;
  while (static_cast<int>(slabs.size()) < kMostSlabs) {
    const Slab slab = best_slab(cells, fill);
    if (static_cast<std::size_t>(slab.points) < fewest) break;
    std::vector<char> inside(total, 0);
    for (int z = slab.from[2]; z < slab.to[2]; ++z)
      for (int y = slab.from[1]; y < slab.to[1]; ++y)
        for (int x = slab.from[0]; x < slab.to[0]; ++x) {
          inside[cells.at(x, y, z)] = 1;
          cells.filled[cells.at(x, y, z)] = cells.points[cells.at(x, y, z)] = 0;
        }
    std::vector<int> members;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (inside[cell_of[k]]) members.push_back(points[k]);
    slabs.push_back(std::move(members));
  }
  return slabs;
}

}  // namespace unseen::cuboids
