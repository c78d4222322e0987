// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/islands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace unseen::planes {
namespace {

constexpr double kApart = 6.0;           // times the noise: how far levels are apart at least,
constexpr double kOfTolerance = 0.25;    // and of the tolerance,
constexpr double kSteps = 3.0;           // and of the steps of rounded coordinates: a slant is no staircase
constexpr double kLeft = 0.4;            // of the squared error: two levels leave less
constexpr double kTwoSides = 0.15;       // of it: what leaves less is the two sides of a thin wall, wherever they lie, if
constexpr double kSide = 0.15;           // of the points are on either
constexpr std::size_t kFewestCells = 36; // of a level, and of an island: three scales each way
constexpr double kTogether = 0.5;        // of the voxels around those of an island, with these: on its level
constexpr int kBeside = 2;               // voxels: around
constexpr int kBins = 64, kRounds = 6;
constexpr int kPieceBits = 3;            // a small piece is 2³ voxels wide

/// The voxels of a region on two parallel planes.
struct TwoLevels {
  std::vector<char> level;  ///< 0 or 1, parallel to the region
  std::array<Moments, 2> sum;
  std::array<std::size_t, 2> cells{};
  PlaneFit fit;  ///< of both, each about its own mean

  double apart() const { return std::abs(fit.normal.dot(sum[1].mean - sum[0].mean)); }
};

/// The height that parts the voxels with the least variance on either side (Otsu, IEEE Trans. SMC 9, 1979), of a histogram.
double threshold_of(const std::vector<double>& height, const VoxelGrid& grid, const std::vector<int>& region) {
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  const double from = *low, step = (*high - from) / kBins;
  if (!(step > 0.0)) return from;
  std::array<double, kBins> count{}, sum{};
  double all = 0, total = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const double n = grid.moments[region[i]].count;
    const int bin = std::min(kBins - 1, static_cast<int>((height[i] - from) / step));
    count[bin] += n;
    sum[bin] += n * height[i];
    all += n;
    total += n * height[i];
  }
  double below = 0, moment = 0, most = 0;
  int best = 0;
  for (int bin = 0; bin + 1 < kBins; ++bin) {
    below += count[bin];
    moment += sum[bin];
    if (below <= 0 || below >= all) continue;
    const double between = std::pow(total * below / all - moment, 2) / (below * (all - below));
    if (between > most) most = between, best = bin + 1;
  }
  return from + best * step;
}

/// The normal of most small pieces: a plane over two levels is tilted by where these lie.
Vec3 local_normal(const VoxelGrid& grid, const std::vector<int>& region) {
  Moments pooled;
  for (const Moments& m : sums_of_cubes(grid, region, kPieceBits)) {
    pooled.count += m.count;
    pooled.scatter += m.scatter;
  }
  return fit_plane(pooled, {}).normal;
}

/// Levels and their common normal in turn.
TwoLevels two_levels(const VoxelGrid& grid, const std::vector<int>& region) {
  TwoLevels levels{std::vector<char>(region.size(), 0), {}, {}, {}};
  levels.fit.normal = local_normal(grid, region);
  std::vector<double> height(region.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < region.size(); ++i) height[i] = levels.fit.normal.dot(grid.moments[region[i]].mean);
    const double threshold = threshold_of(height, grid, region);
    bool same = round > 0;
    levels.sum = {};
    levels.cells = {};
    for (std::size_t i = 0; i < region.size(); ++i) {
      const char up = height[i] >= threshold ? 1 : 0;
      same = same && up == levels.level[i];
      levels.level[i] = up;
      levels.sum[up] += grid.moments[region[i]];
      ++levels.cells[up];
    }
    levels.fit = fit_plane({levels.sum[0].count + levels.sum[1].count, levels.sum[0].mean, levels.sum[0].scatter + levels.sum[1].scatter}, {});
    if (same) break;
  }
  return levels;
}

VoxelSet set_of(const VoxelGrid& grid, const std::vector<int>& region, const TwoLevels& levels, char level) {
  VoxelSet set = grid.empty_set();
  for (std::size_t i = 0; i < region.size(); ++i)
    if (levels.level[i] == level) grid.insert(set, region[i]);
  return set;
}

/// Whether the voxels of a level lie side by side, and not here and there among the others as noise does.
bool lie_together(const VoxelGrid& grid, const std::vector<int>& region, const TwoLevels& levels, char level, const VoxelSet& own, const VoxelSet& others) {
  std::size_t same = 0, all = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (levels.level[i] != level) continue;
    grid.for_neighbours(region[i], kBeside, own, [&](int) { ++same, ++all; });
    grid.for_neighbours(region[i], kBeside, others, [&](int) { ++all; });
  }
  return static_cast<double>(same) > kTogether * static_cast<double>(all);
}

/// The connected pieces of a level, whose voxels `left` holds; what is too small for one goes to the largest. None if all are too small.
CellSets pieces_of(const VoxelGrid& grid, const std::vector<int>& region, VoxelSet left) {
  CellSets found;
  std::vector<int> crumbs;
  for (const int start : region) {
    if (!grid.contains(left, static_cast<std::size_t>(start))) continue;
    std::vector<int> piece = {start};
    grid.erase(left, static_cast<std::size_t>(start));
    for (std::size_t at = 0; at < piece.size(); ++at)
      grid.for_neighbours(piece[at], kBeside, left, [&](int k) {
        grid.erase(left, static_cast<std::size_t>(k));
        piece.push_back(k);
      });
    if (piece.size() < kFewestCells) crumbs.insert(crumbs.end(), piece.begin(), piece.end());
    else found.push_back(std::move(piece));
  }
  if (found.empty()) return found;
  const auto largest = std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  largest->insert(largest->end(), crumbs.begin(), crumbs.end());
  for (std::vector<int>& piece : found) std::sort(piece.begin(), piece.end());
  return found;
}

}  // namespace

Islands islands_in(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit) {
  const double least = std::max(kOfTolerance * grid.tolerance, kSteps * grid.rounding), error = fit.rms * fit.rms * whole.count;
  // The smallest island, as high as it must be, makes the rms this much.
  if (fit.rms < least * std::sqrt(static_cast<double>(kFewestCells) / static_cast<double>(region.size()))) return {};
  const TwoLevels levels = two_levels(grid, region);
  const double left = levels.fit.rms * levels.fit.rms * whole.count;
  if (std::min(levels.cells[0], levels.cells[1]) < kFewestCells || left > kLeft * error || levels.apart() < std::max(least, kApart * levels.fit.rms)) return {};
  const std::array<VoxelSet, 2> sets = {set_of(grid, region, levels, 0), set_of(grid, region, levels, 1)};
  const char smaller = levels.cells[1] < levels.cells[0];
  const bool two_sides = left < kTwoSides * error && std::min(levels.sum[0].count, levels.sum[1].count) > kSide * whole.count;
  if (!two_sides && !lie_together(grid, region, levels, smaller, sets[smaller], sets[!smaller])) return {};
  Islands islands{pieces_of(grid, region, sets[0]), left};
  CellSets upper = pieces_of(grid, region, sets[1]);
  if (islands.pieces.empty() || upper.empty()) return {};
  std::move(upper.begin(), upper.end(), std::back_inserter(islands.pieces));
  return islands;
}

}  // namespace unseen::planes
