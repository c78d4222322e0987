// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <utility>
#include <vector>

#include "planes/scan/cells.h"

namespace unseen::planes {

constexpr double kMostPoints = 60;  ///< of a patch that count as independent: noise is correlated

/// S_j with its local fit P_j (thesis Section 3.3.1): a connected set of voxels with consistent normals.
struct Patch {
  std::vector<int> cells;  ///< voxel indices, ascending
  Moments moments;
  PlaneFit fit;
  double area = 0;        ///< m², of a rectangle with the same spread (2D: length, m)
  double variance_u = 0;  ///< rad², of the fitted normal's tilt along u, robust to noise that is correlated
  double variance_v = 0;  ///< the same along v
  double doubt_u = 0;     ///< rad², of that tilt when patches are compared: more than noise is at work in scans
  double doubt_v = 0;     ///< the same along v
  double systematic_u = 0;  ///< the part of doubt_u that no noise model contains
  double systematic_v = 0;  ///< the same along v
  double waves = 1.0;       ///< the share of the scene's waves (variance) that it may have, as its own smaller pieces tell
  bool bowed = false;       ///< a strip of a curved surface: which way it faces means nothing
};

/// How far noise that is correlated over more than a small surface turns it (see waves.cpp).
struct Waves {
  double finest = 0;           ///< m, the width of surfaces that `excess` begins with; each following ones are twice as wide
  std::vector<double> excess;  ///< the squared tilt of such a surface, over (rms / spread)² of its own

  /// Of the tilt (rad²) of a surface along an axis, from its rms and its spread along and across that axis (m).
  double variance(double rms, double spread, double across) const;
};

struct Patches {
  std::vector<Patch> patches;                  ///< by falling area
  double least_noise = 0;                      ///< m, half the typical noise, or what rounding leaves: for make_patch
  Waves waves;                                 ///< that large patches show
  std::vector<int> patch_of_cell;              ///< −1 = none
  std::vector<std::pair<int, int>> adjoining;   ///< closest points nearer than 2ρ, in drawings 3ρ (where points are sparse 1.6 and 2.5 times their spacing, or so); a < b
  std::vector<std::pair<int, int>> neighbours;  ///< those of them whose local normals there are within τ
};

Moments sum_of(const VoxelGrid& grid, const std::vector<int>& cells);

/// Moments of the cubes, 2^bits voxels wide, that a set of voxels lies in.
std::vector<Moments> sums_of_cubes(const VoxelGrid& grid, const std::vector<int>& cells, int bits);

/// Of points to their own plane, m².
double squared_error(const Moments& m, const Space& space);

/// Those of a set of voxels that lie on its plane, without what stands on it or hangs over it.
std::vector<int> core_of(const VoxelGrid& grid, const Space& space, const std::vector<int>& cells);

/// Moments, fit, area and standard errors of a set of voxels. Points along one sweep of a scanner lie exactly in
/// the sweep's own plane, however noisy they are: no fit counts as better than `least_noise` (m) allows.
Patch make_patch(const VoxelGrid& grid, const Space& space, std::vector<int> cells, double least_noise, const Cells& surface = {});

/// The variance (rad²) of a fit's tilt along one of its axes with at least as much as independent points leave, `spread` (m) along it.
double tilt_noise(const Moments& moments, const PlaneFit& fit, double variance, double spread);

/// The waves that patches show: how far square windows of them are turned against the whole; and each patch's share of them.
Waves measure_waves(const VoxelGrid& grid, Patches& patches, const Context& context);

/// Makes a patch's tilts as uncertain as waves leave them.
void add_waves(const Waves& waves, Patch& patch);

/// Marks patches that are bent as the turns to those that adjoin ask for.
void mark_bowed(const VoxelGrid& grid, const Context& context, Patches& patches);

/// Grows regions over neighbouring voxels, from the flattest upward, while normals stay within `angle` (rad)
/// of the running fit and residuals within the local scale; then splits what two planes explain clearly
/// better, and joins what one explains as well.
Patches segment(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle, Context& context);

/// Stages of `segment`, on sets of voxels.
using CellSets = std::vector<std::vector<int>>;
CellSets grow_regions(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle,
                      Context& context);
/// Cuts regions while that pays, but none of those in `uncut`, which are sorted and known to have no such cut.
CellSets split_regions(const VoxelGrid& grid, const Space& space, CellSets regions, Context& context, const CellSets& uncut = {});
CellSets merge_regions(const VoxelGrid& grid, const Cells& cells, const Space& space, double angle,
                       CellSets regions, Context& context);
/// Leaves out regions that the planes of larger ones nearby explain within the local scale, or explain in good part and better than the
/// region's own plane: rims where two planes meet, not structures of their own.
CellSets drop_rims(const VoxelGrid& grid, const Cells& cells, const Space& space, CellSets regions,
                   Context& context);
/// Leaves out single voxels that lie farther from their region's plane than its noise explains: outliers pull small regions round.
CellSets drop_strays(const VoxelGrid& grid, const Space& space, CellSets regions, const Context& context);

}  // namespace unseen::planes
