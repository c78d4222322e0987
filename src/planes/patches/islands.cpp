// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/islands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace unseen::planes {
namespace {

constexpr double kApart = 5.0, kOfTolerance = 0.25;  // times the noise, and of the tolerance: how far levels are apart at least
constexpr double kGain = 0.4;                       // of the squared error: two levels leave less
constexpr std::size_t kFewestCells = 36;            // of a level, and of an island: three scales each way
constexpr double kTogether = 0.5;                   // of the neighbours of an island's voxels: on its level
constexpr int kBeside = 2;                          // voxels: neighbours
constexpr int kBins = 64, kRounds = 6;
constexpr int kPiece = 3;                           // a small piece is 2³ voxels wide

/// The voxels of a region on two parallel planes.
struct TwoLevels {
  std::vector<char> upper;  ///< parallel to the region
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
  std::map<VoxelKey, Moments> pieces;
  for (const int i : region) {
    const VoxelKey& k = grid.keys[i];
    pieces[{k[0] >> kPiece, k[1] >> kPiece, k[2] >> kPiece}] += grid.moments[i];
  }
  Moments pooled;
  for (const auto& [key, m] : pieces) {
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
      const char up = height[i] >= threshold;
      same = same && up == levels.upper[i];
      levels.upper[i] = up;
      levels.sum[up] += grid.moments[region[i]];
      ++levels.cells[up];
    }
    levels.fit = fit_plane({levels.sum[0].count + levels.sum[1].count, levels.sum[0].mean, levels.sum[0].scatter + levels.sum[1].scatter}, {});
    if (same) break;
  }
  return levels;
}

VoxelSet set_of(const VoxelGrid& grid, const std::vector<int>& region, const std::vector<char>& upper, char level) {
  VoxelSet set = grid.empty_set();
  for (std::size_t i = 0; i < region.size(); ++i)
    if (upper[i] == level) grid.insert(set, region[i]);
  return set;
}

/// Whether the voxels of the smaller level lie side by side, and not here and there as noise does.
bool lie_together(const VoxelGrid& grid, const std::vector<int>& region, const TwoLevels& levels) {
  const char smaller = levels.cells[1] < levels.cells[0];
  const VoxelSet own = set_of(grid, region, levels.upper, smaller), other = set_of(grid, region, levels.upper, !smaller);
  std::size_t same = 0, all = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (levels.upper[i] != smaller) continue;
    grid.for_neighbours(region[i], kBeside, own, [&](int) { ++same, ++all; });
    grid.for_neighbours(region[i], kBeside, other, [&](int) { ++all; });
  }
  return static_cast<double>(same) > kTogether * static_cast<double>(all);
}

/// The connected pieces of a level; what is too small for one goes to the largest.
void add_pieces(const VoxelGrid& grid, const std::vector<int>& region, const std::vector<char>& upper, char level, CellSets& pieces) {
  VoxelSet left = set_of(grid, region, upper, level);
  CellSets found;
  std::vector<int> crumbs;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (upper[i] != level || !grid.contains(left, region[i])) continue;
    std::vector<int> piece = {region[i]};
    grid.erase(left, region[i]);
    for (std::size_t at = 0; at < piece.size(); ++at)
      grid.for_neighbours(piece[at], kBeside, left, [&](int k) {
        grid.erase(left, static_cast<std::size_t>(k));
        piece.push_back(k);
      });
    if (piece.size() < kFewestCells) crumbs.insert(crumbs.end(), piece.begin(), piece.end());
    else found.push_back(std::move(piece));
  }
  if (found.empty()) found.emplace_back();
  auto largest = std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  largest->insert(largest->end(), crumbs.begin(), crumbs.end());
  std::move(found.begin(), found.end(), std::back_inserter(pieces));
}

}  // namespace

Islands islands_in(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit) {
  const double least = kOfTolerance * grid.tolerance, error = fit.rms * fit.rms * whole.count;
  if (fit.rms < least * std::sqrt(static_cast<double>(kFewestCells) / static_cast<double>(region.size()))) return {};
  const TwoLevels levels = two_levels(grid, region);
  const double left = levels.fit.rms * levels.fit.rms * whole.count;
  if (std::min(levels.cells[0], levels.cells[1]) < kFewestCells || left > kGain * error || levels.apart() < std::max(least, kApart * levels.fit.rms) ||
      !lie_together(grid, region, levels))
    return {};
  Islands islands{{}, left};
  for (const char level : {0, 1}) add_pieces(grid, region, levels.upper, level, islands.pieces);
  return islands;
}

}  // namespace unseen::planes
