// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/model_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "unseen/core/convex.h"

namespace unseen::cuboids {
namespace {

constexpr int kCells = 36;               // along the longest side
constexpr double kLeastShare = 0.01;     // of the filled cells: smaller slabs are debris
constexpr std::size_t kMostSlabs = 24;
constexpr double kTrimmed = 0.005;       // share of a slab's points at each end that may be stray

/// The block with the largest sum of weights, where a filled cell gains `gain` and any other loses `loss`: sums over
/// columns of cells, and the largest run along z for each rectangle in x and y (Kadane).
std::optional<CellBlock> heaviest(const CellGrid& grid, const std::vector<char>& taken, double gain, double loss) {
  const auto [nx, ny, nz] = grid.size;
  const double forbidden = -1e9;
  double best = 0.0;
  CellBlock block;
  std::vector<double> sums(static_cast<std::size_t>(ny) * nz);
  for (int x0 = 0; x0 < nx; ++x0) {
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int x1 = x0; x1 < nx; ++x1) {
      for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y) {
          const std::size_t cell = grid.at(x1, y, z);
          sums[static_cast<std::size_t>(y) * nz + z] += taken[cell] ? forbidden : grid.cells[cell] ? gain : -loss;
        }
      for (int y0 = 0; y0 < ny; ++y0) {
        std::vector<double> column(static_cast<std::size_t>(nz), 0.0);
        for (int y1 = y0; y1 < ny; ++y1) {
          double run = 0.0;
          int start = 0;
          for (int z = 0; z < nz; ++z) {
            column[z] += sums[static_cast<std::size_t>(y1) * nz + z];
            if (run <= 0.0) {
              run = 0.0;
              start = z;
            }
            run += column[z];
            if (run > best + 1e-9) {
              best = run;
              block = {{x0, y0, start}, {x1 + 1, y1 + 1, z + 1}};
            }
          }
        }
      }
    }
  }
  return best > 0.0 ? std::optional(block) : std::nullopt;
}

/// Fills what is enclosed from four sides and above.
void fill_inside(CellGrid& grid) {
  const CellGrid surface = grid;
  const auto met = [&](std::array<int, 3> at, int axis, int step) {
    for (at[axis] += step; at[axis] >= 0 && at[axis] < grid.size[axis]; at[axis] += step)
      if (surface.cells[surface.at(at[0], at[1], at[2])]) return true;
    return false;
  };
  for (int z = 0; z < grid.size[2]; ++z)
    for (int y = 0; y < grid.size[1]; ++y)
      for (int x = 0; x < grid.size[0]; ++x) {
        const std::array<int, 3> at = {x, y, z};
        if (met(at, 2, 1) && met(at, 0, 1) && met(at, 0, -1) && met(at, 1, 1) && met(at, 1, -1)) grid.cells[grid.at(x, y, z)] = 1;
      }
}

}  // namespace

double plan_yaw(const std::vector<Vec3>& points) {
  std::vector<Vec2> plan;
  for (const Vec3& p : points) plan.push_back(p.head<2>());
  if (plan.size() < 3) return 0.0;
  const std::vector<Vec2> hull = convex_hull(std::move(plan));
  double least = std::numeric_limits<double>::infinity(), yaw = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 along = (hull[(i + 1) % hull.size()] - hull[i]).normalized(), across(-along.y(), along.x());
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec2& p : hull) {
      const Vec2 q(along.dot(p), across.dot(p));
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    const double area = (high - low).prod();
    if (area >= least - 1e-12) continue;
    least = area;
    yaw = std::atan2(along.y(), along.x());
  }
  yaw = std::fmod(yaw + 2.0 * kPi, 0.5 * kPi);
  return yaw;
}

std::vector<CellBlock> greedy_slabs(const CellGrid& filled, double fill, int least) {
  std::vector<CellBlock> slabs;
  std::vector<char> taken(filled.cells.size(), 0);
  while (slabs.size() < kMostSlabs) {
    // A block gains as soon as more than `fill` of it is filled, and so does each layer that it grows by.
    const auto block = heaviest(filled, taken, 1.0 - fill, fill);
    if (!block) break;
    int held = 0;
    for (int z = block->low[2]; z < block->high[2]; ++z)
      for (int y = block->low[1]; y < block->high[1]; ++y)
        for (int x = block->low[0]; x < block->high[0]; ++x) {
          const std::size_t cell = filled.at(x, y, z);
          held += filled.cells[cell];
          taken[cell] = 1;
        }
    if (held < least) break;
    slabs.push_back(*block);
  }
  return slabs;
}

std::vector<OrientedBox> fit_model_boxes(const std::vector<Vec3>& points, double fill) {
  std::vector<OrientedBox> boxes;
  if (points.empty()) return boxes;
  const Mat3 axes = Eigen::AngleAxisd(plan_yaw(points), Vec3::UnitZ()).toRotationMatrix();
  std::vector<Vec3> local;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    local.push_back(axes.transpose() * p);
    low = low.cwiseMin(local.back());
    high = high.cwiseMax(local.back());
  }
  const double cell = std::max((high - low).maxCoeff() / kCells, 1e-6);
  CellGrid grid;
  for (int k = 0; k < 3; ++k) grid.size[k] = std::max(1, static_cast<int>(std::ceil((high[k] - low[k]) / cell - 1e-9)));
  grid.cells.assign(static_cast<std::size_t>(grid.size[0]) * grid.size[1] * grid.size[2], 0);
  const auto cell_of = [&](const Vec3& p) {
    std::array<int, 3> at;
    for (int k = 0; k < 3; ++k) at[k] = std::clamp(static_cast<int>((p[k] - low[k]) / cell), 0, grid.size[k] - 1);
    return at;
  };
  for (const Vec3& p : local) {
    const auto at = cell_of(p);
    grid.cells[grid.at(at[0], at[1], at[2])] = 1;
  }
  fill_inside(grid);
  const auto filled = std::count(grid.cells.begin(), grid.cells.end(), 1);
  for (const CellBlock& slab : greedy_slabs(grid, fill, std::max(4, static_cast<int>(kLeastShare * static_cast<double>(filled))))) {
    std::array<std::vector<double>, 3> along;
    for (const Vec3& p : local) {
      const auto at = cell_of(p);
      bool in = true;
      for (int k = 0; k < 3; ++k) in = in && at[k] >= slab.low[k] && at[k] < slab.high[k];
      for (int k = 0; k < 3 && in; ++k) along[k].push_back(p[k]);
    }
    if (along[0].size() < 4) continue;
    OrientedBox box;
    box.axes = axes;
    Vec3 middle;
    for (int k = 0; k < 3; ++k) {
      std::sort(along[k].begin(), along[k].end());
      const std::size_t trimmed = static_cast<std::size_t>(kTrimmed * static_cast<double>(along[k].size()));
      const double first = along[k][trimmed], last = along[k][along[k].size() - 1 - trimmed];
      middle[k] = 0.5 * (first + last);
      box.half_size[k] = 0.5 * (last - first);
    }
    box.center = axes * middle;
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace unseen::cuboids
