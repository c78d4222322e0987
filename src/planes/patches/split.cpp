// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Splitting of regions: planes must not cut corners, but waves of correlated noise are none.
#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/patches/cuts.h"
#include "planes/scan/weighted.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kSplitCells = 12;                // smaller regions are left alone
constexpr int kLocalBits = 2;                          // small neighbourhoods are 2² voxels wide,
constexpr double kLocalPoints = 12, kLocalFlat = 0.3;  // with so many points, and this flat (rms over spread)
constexpr double kStraight = 1.5;                      // times their noise is left by pieces that are straight
constexpr std::size_t kWavyCells = 100;                // voxels of what tells how wavy the scan is:
constexpr double kWavyShare = 0.25, kWavy = 3.0;       // this share of the surface has less rms, and waves no more than so many times that

/// A region, or a piece of one.
struct RegionPart {
  std::vector<int> cells;  ///< none if it has pieces
  int whole = -1;          ///< that it is a piece of
  std::size_t size = 0;    ///< voxels
  double count = 0, error = 0;  ///< points; m², squared, to its plane
  double straight = std::numeric_limits<double>::infinity();  ///< m², what its pieces may leave, or it is not bent but wavy
  bool pieces = false;     ///< has them,
  bool cut = false;        ///< and they stay apart
  double left = 0;         ///< m², what they leave

  double rms() const { return std::sqrt(error / count); }
};

/// The variance (m²) of points about the planes of small neighbourhoods; infinite where points are too sparse for these.
double local_variance(const VoxelGrid& grid, const std::vector<int>& cells) {
  double error = 0, count = 0;
  for (const Moments& m : sums_of_cubes(grid, cells, kLocalBits)) {
    const PlaneFit fit = fit_plane(m, {});
    if (m.count < kLocalPoints || fit.rms > kLocalFlat * fit.spread_v) continue;
    error += fit.rms * fit.rms * m.count;
    count += m.count - 3.0;
  }
  return count > 0.0 ? error / count : std::numeric_limits<double>::infinity();
}

/// The rms (m) that a share of the surface does not exceed: of regions and pieces that are whole.
double typical_rms(const std::vector<RegionPart>& parts) {
  std::vector<std::pair<double, double>> rms;  // by voxels
  for (const RegionPart& part : parts)
    if (!part.cut && !(part.whole >= 0 && !parts[part.whole].cut) && part.size >= kWavyCells) rms.emplace_back(part.rms(), part.size);
  return rms.empty() ? 0.0 : weighted_quantile(std::move(rms), kWavyShare);
}

/// Joins again what was cut at shallow bends where the pieces are not straight either and one plane leaves no more than `most` (rms, m).
void mend_waves(std::vector<RegionPart>& parts, double most) {
  for (RegionPart& part : parts) part.left = 0.0, part.cut = part.pieces;
  for (std::size_t p = parts.size(); p-- > 0;) {  // pieces come after what they are cut from
    RegionPart& part = parts[p];
    if (part.cut && part.left > part.straight && part.rms() < most) part.cut = false;
    if (!part.cut) part.left = part.error;
    if (part.whole >= 0) parts[part.whole].left += part.left;
  }
  for (RegionPart& part : parts)  // pieces of what is whole are whole with it
    if (part.whole >= 0 && !parts[part.whole].cut) part.cut = false;
}

}  // namespace

CellSets split_regions(const VoxelGrid& grid, const Space& space, CellSets regions, Context& context, const CellSets& uncut) {
  std::vector<RegionPart> parts;
  const auto add = [&](std::vector<int> cells, int whole) {
    parts.push_back({std::move(cells), whole});
    parts.back().size = parts.back().cells.size();
  };
  for (std::vector<int>& region : regions) add(std::move(region), -1);
  for (std::size_t begin = 0; begin < parts.size();) {
    const std::size_t end = parts.size();
    std::vector<Pieced> cuts(end - begin);
    parallel_blocks(context, end - begin, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t p = from; p < to; ++p) {
        RegionPart& part = parts[begin + p];
        const Moments sum = sum_of(grid, part.cells);
        part.count = sum.count;
        part.error = squared_error(sum, space);
        if (part.size < kSplitCells || std::binary_search(uncut.begin(), uncut.end(), part.cells)) continue;
        cuts[p] = best_cut(grid, space, part.cells);
        if (cuts[p].bent && !space.is_2d()) part.straight = kStraight * kStraight * local_variance(grid, part.cells) * sum.count;
      }
    });
    for (std::size_t p = begin; p < end; ++p) {
      if (cuts[p - begin].pieces.empty()) continue;
      parts[p].cells.clear();
      parts[p].pieces = true;
      for (std::vector<int>& piece : cuts[p - begin].pieces) add(std::move(piece), static_cast<int>(p));
    }
    begin = end;
  }
  mend_waves(parts, std::numeric_limits<double>::infinity());  // as far as it may go: what is whole then tells how wavy the scan is
  mend_waves(parts, kWavy * typical_rms(parts));
  std::vector<int> within(parts.size());  // the outermost whole one
  CellSets result;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const int whole = parts[p].whole;
    within[p] = whole >= 0 && !parts[whole].cut ? within[whole] : static_cast<int>(p);
    if (within[p] == static_cast<int>(p)) continue;
    std::vector<int>& cells = parts[within[p]].cells;
    cells.insert(cells.end(), parts[p].cells.begin(), parts[p].cells.end());
    parts[p].cells.clear();
  }
  for (RegionPart& part : parts)
    if (!part.cells.empty()) {
      std::sort(part.cells.begin(), part.cells.end());
      result.push_back(std::move(part.cells));
    }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace unseen::planes
