// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "planes/patches/facets.h"
#include "planes/patches/islands.h"

namespace unseen::planes {
namespace {

constexpr double kSplitGain = 0.6;       // a split must leave less than this share of the squared error
constexpr double kSplitAngle = 0.08;     // rad: flatter hinges are noise or curvature, unless
constexpr double kShallow = 0.02, kShallowGain = 0.3;  // they are above this, rad, and leave less than this share,
constexpr std::size_t kShallowCells = 100;  // of so many voxels or more,
constexpr double kStep = 4.0;            // or parallel sides are so many times their noise apart where they meet,
constexpr double kRounded = 3.0, kLeastStep = 0.01;  // and of the steps of coordinates, and of the tolerance
constexpr double kBentShare = 0.25;       // of the tolerance: what is bent several times is off one plane by more, in the mean: noise may be correlated
constexpr int kMostPieces = 5;           // straight ones, of what is bent several times
constexpr int kSlices = 12;
constexpr int kFiner = 4;                // times as many, of what is bent or stepped more often than that
constexpr int kShift = 3;                // of these, from one window to the next
constexpr double kSteppedGain = 0.4;     // there, of steps

/// A region in slices of equal thickness along an axis.
struct Slices {
  std::vector<Moments> sum;
  std::vector<int> of_voxel;  ///< parallel to the region
};

Slices slices_along(const Vec3& axis, const VoxelGrid& grid, const std::vector<int>& region, int count = kSlices) {
  std::vector<double> along;
  for (const int i : region) along.push_back(axis.dot(grid.moments[i].mean));
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  const double step = (*high - *low) / count;
  Slices slices;
  if (!(step > 0)) return slices;
  slices.sum.resize(count);
  for (std::size_t i = 0; i < region.size(); ++i) {
    slices.of_voxel.push_back(std::min(count - 1, static_cast<int>((along[i] - *low) / step)));
    slices.sum[slices.of_voxel[i]] += grid.moments[region[i]];
  }
  return slices;
}

/// A run of slices and its plane.
struct Piece {
  Moments sum;
  int slices;
  PlaneFit fit;
};

/// How far the planes of two runs of slices are apart where they meet, if they are parallel but for a shallow hinge.
double step_between(const Piece& a, const Piece& b) {
  const double share = static_cast<double>(a.slices) / (a.slices + b.slices);
  const Vec3 apart = b.sum.mean - a.sum.mean;
  return std::abs(share * a.fit.normal.dot(apart) + (1.0 - share) * std::copysign(1.0, a.fit.normal.dot(b.fit.normal)) * b.fit.normal.dot(apart));
}

/// How high a step must be to be none of noise (its variance, m²), of rounding, or of nothing.
double least_step(const VoxelGrid& grid, double variance) {
  return std::max({kStep * std::sqrt(variance), kRounded * grid.rounding, kLeastStep * grid.tolerance});
}

struct Cut {
  int at = 0;  ///< slices below it are one side; 0 = none
  double error = std::numeric_limits<double>::infinity();
  bool bent = false;      ///< a little: between flat hinges and steps
  bool too_many = false;  ///< pieces
};

/// The single cut that leaves least, if that is less than `most`. Flat hinges must leave less than `shallow`, steps less than `stepped`.
Cut best_single(std::span<const Moments> slice, const VoxelGrid& grid, const Space& space, double most, double shallow, double stepped) {
  const double least = space.is_2d() ? 5 : 10;  // points
  std::vector<Moments> above(kSlices + 1);
  for (int c = kSlices - 1; c >= 0; --c) above[c] = above[c + 1] + slice[c];
  Cut best{0, most};
  Moments below;
  for (int c = 1; c < kSlices; ++c) {
    below += slice[c - 1];
    if (below.count < least || above[c].count < least) continue;
    const Piece a{below, c, fit_plane(below, space)}, b{above[c], kSlices - c, fit_plane(above[c], space)};
    const double error = a.fit.rms * a.fit.rms * below.count + b.fit.rms * b.fit.rms * above[c].count;
    if (error >= best.error) continue;
    const double hinge = line_angle(a.fit.normal, b.fit.normal);
    if (hinge < kSplitAngle && error > (hinge < kShallow ? stepped : shallow)) continue;
    if (hinge < kShallow && step_between(a, b) < least_step(grid, error / (below.count + above[c].count))) continue;
    best = {c, error, hinge >= kShallow && hinge < kSplitAngle};
  }
  return best;
}

/// Slices cut into 1 to kMostPieces pieces, by their number: where they end, last first, and the squared error that they leave.
struct Pieces {
  std::vector<std::vector<int>> ends = std::vector<std::vector<int>>(kMostPieces + 1);
  std::vector<double> error = std::vector<double>(kMostPieces + 1);
};

/// The pieces that leave least, by dynamic programming over `error` of slices [i, j).
Pieces best_pieces(const std::vector<std::vector<double>>& error) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> least(kMostPieces + 1, std::vector<double>(kSlices + 1, infinity));
  std::vector<std::vector<int>> from(kMostPieces + 1, std::vector<int>(kSlices + 1, 0));
  least[0][0] = 0;
  Pieces pieces;
  for (int k = 1; k <= kMostPieces; ++k) {
    for (int j = k; j <= kSlices; ++j)
      for (int i = k - 1; i < j; ++i)
        if (const double e = least[k - 1][i] + error[i][j]; e < least[k][j]) least[k][j] = e, from[k][j] = i;
    pieces.error[k] = least[k][kSlices];
    pieces.ends[k] = {kSlices};
    for (int p = k; p > 0; --p) pieces.ends[k].push_back(from[p][pieces.ends[k].back()]);
  }
  return pieces;
}

/// Of the fewest straight pieces that explain most of what one plane does not, but planes of single slices do: the cut at the sharpest bend, or at the
/// highest step if nothing is bent; with the error of most pieces.
Cut sharpest_bend(const std::vector<Moments>& slice, const VoxelGrid& grid, const Space& space) {
  constexpr double kFewest = 10;  // points in a slice
  std::vector<std::vector<double>> error(kSlices, std::vector<double>(kSlices + 1, 0.0));
  double by_slices = 0, count = 0;
  for (int i = 0; i < kSlices; ++i) {
    if (slice[i].count < kFewest) return {};
    Moments sum;
    for (int j = i + 1; j <= kSlices; ++j) {
      sum += slice[j - 1];
      error[i][j] = squared_error(sum, space);
    }
    by_slices += error[i][i + 1];
    count += slice[i].count;
  }
  const double bent = error[0][kSlices] - by_slices;
  const double least_bent = std::pow(kBentShare * grid.tolerance, 2) * count;
  if (bent < std::min(least_bent, by_slices)) return {};
  const Pieces pieces = best_pieces(error);
  int k = 2;
  while (k <= kMostPieces && pieces.error[k] - by_slices > kShallowGain * bent) ++k;
  if (k > kMostPieces) return {.too_many = true};
  const std::vector<int>& ends = pieces.ends[k];
  std::vector<Piece> straight;
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    Piece piece{{}, ends[p] - ends[p + 1], {}};
    for (int i = ends[p + 1]; i < ends[p]; ++i) piece.sum += slice[i];
    piece.fit = fit_plane(piece.sum, space);
    straight.push_back(std::move(piece));
  }
  Cut cut{0, pieces.error[kMostPieces]};
  double sharpest = bent < least_bent ? std::numeric_limits<double>::infinity() : kShallow;
  double highest = least_step(grid, by_slices / count);
  int bend_at = 0, step_at = 0;
  for (std::size_t p = 0; p + 1 < straight.size(); ++p) {
    const double bend = line_angle(straight[p].fit.normal, straight[p + 1].fit.normal);
    if (bend > sharpest) sharpest = bend, bend_at = ends[p + 1];
    if (bend > kShallow) continue;
    if (const double step = step_between(straight[p], straight[p + 1]); step > highest) highest = step, step_at = ends[p + 1];
  }
  cut.at = bend_at > 0 ? bend_at : step_at;
  cut.bent = bend_at > 0 && sharpest < kSplitAngle;
  return cut;
}

/// Of a region that is bent or stepped too often for few pieces: the cut that leaves the least share of the error within some kSlices of its finer slices.
Cut best_within(const std::vector<Moments>& slice, const VoxelGrid& grid, const Space& space) {
  Cut best{0, kSteppedGain};  // the error as a share
  for (int from = 0; from + kSlices <= static_cast<int>(slice.size()); from += kShift) {
    const auto window = std::span(slice).subspan(from, kSlices);
    const double error = squared_error(std::accumulate(window.begin(), window.end(), Moments{}, [](const Moments& a, const Moments& b) { return a + b; }), space);
    if (const Cut cut = best_single(window, grid, space, best.error * error, kShallowGain * error, best.error * error); cut.at > 0) best = {from + cut.at, cut.error / error, cut.bent};
  }
  return best;
}

}  // namespace

double squared_error(const Moments& m, const Space& space) {
  const PlaneFit fit = fit_plane(m, space);
  return fit.rms * fit.rms * m.count;
}

Pieced best_cut(const VoxelGrid& grid, const Space& space, const std::vector<int>& region) {
  const Moments whole = sum_of(grid, region);
  const PlaneFit fit = fit_plane(whole, space);
  const bool large = region.size() >= kShallowCells;
  const double error = squared_error(whole, space), shallow = large ? kShallowGain * error : 0.0;
  const int directions = space.is_2d() ? 1 : 8;
  const auto slices_of = [&](int count) {
    std::vector<Slices> slices;
    for (int d = 0; d < directions; ++d) {
      const double angle = kPi * d / directions;
      Slices along = slices_along(std::cos(angle) * fit.u + std::sin(angle) * fit.v, grid, region, count);
      if (!along.sum.empty()) slices.push_back(std::move(along));
    }
    return slices;
  };
  std::vector<Slices> slices = slices_of(kSlices);
  Cut best{0, kSplitGain * error};
  const Slices* of_best = nullptr;
  for (const Slices& along : slices)
    if (const Cut cut = best_single(along.sum, grid, space, best.error, shallow, shallow); cut.at > 0) best = cut, of_best = &along;
  if (large && !space.is_2d())
    if (Islands islands = islands_in(grid, region, whole, fit); !islands.pieces.empty() && islands.error < best.error) return {std::move(islands.pieces)};
  if (of_best == nullptr && large && !space.is_2d()) {
    if (Facets facets = facets_in(grid, region, whole, fit); !facets.pieces.empty()) return {std::move(facets.pieces), true};
    best = {};
    bool too_many = false;
    for (const Slices& along : slices) {
      const Cut cut = sharpest_bend(along.sum, grid, space);
      too_many |= cut.too_many;
      if (cut.at > 0 && cut.error < best.error) best = cut, of_best = &along;
    }
    if (of_best == nullptr && too_many) {
      slices = slices_of(kFiner * kSlices);
      for (const Slices& along : slices)
        if (const Cut cut = best_within(along.sum, grid, space); cut.at > 0 && cut.error < best.error) best = cut, of_best = &along;
    }
  }
  if (of_best == nullptr) return {};
  Pieced cut{CellSets(2), best.bent};
  for (std::size_t i = 0; i < region.size(); ++i) cut.pieces[of_best->of_voxel[i] < best.at ? 0 : 1].push_back(region[i]);
  return cut;
}

}  // namespace unseen::planes
