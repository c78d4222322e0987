// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/cells.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr int kLevels = 4;
constexpr int kGathered = 2;             // voxels to either side
constexpr double kFlattest = 0.15;       // λ₀/λ₁ above which a neighbourhood has no reliable normal
constexpr double kLeastReach = 1.25, kMostReach = 5.0;  // of the scale
constexpr double kProves = 0.03;         // variation above which a normal proves nothing
const double kCompatible = std::cos(kPi / 4);
constexpr double kNormalError = 0.06;    // rad, largest standard error of a normal

struct Level {
  VoxelGrid grid;                 // empty for level 0: the input grid itself
  std::vector<int> parent;        // of each voxel of level 0
};

/// Moments of everything within `radius` of `center`, a point of `voxel`.
Moments gather(const VoxelGrid& grid, std::size_t voxel, const Vec3& center, double radius) {
  double n = 0;
  Vec3 first = Vec3::Zero();
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  grid.for_neighbours(voxel, kGathered, [&](int i) {
    const Moments& m = grid.moments[i];
    const Vec3 d = m.mean - center;
    const double inside = d.squaredNorm() > radius * radius ? 0.0 : 1.0;  // no jump: as many lie in as out
    const double count = inside * m.count;
    const Vec3 sum = count * d;
    n += count;
    first += sum;
    xx += inside * m.scatter(0, 0) + sum.x() * d.x();
    xy += inside * m.scatter(1, 0) + sum.x() * d.y();
    xz += inside * m.scatter(2, 0) + sum.x() * d.z();
    yy += inside * m.scatter(1, 1) + sum.y() * d.y();
    yz += inside * m.scatter(2, 1) + sum.y() * d.z();
    zz += inside * m.scatter(2, 2) + sum.z() * d.z();
  });
  Moments m;
  m.count = n;
  m.mean = center + first / n;
  m.scatter << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  m.scatter -= first * first.transpose() / n;
  return m;
}

/// The line that most input normals of a voxel lie along, if they agree; else zero.
Vec3 input_normal(const Mat3& sum, const Space& space) {
  if (!(sum.trace() > 0.5)) return Vec3::Zero();
  const SymmetricEigen<3> eigen = symmetric_eigen(sum);
  if (eigen.values[2] < 0.8 * sum.trace()) return Vec3::Zero();
  const Vec3 n = space.admissible(eigen.vectors.col(2));
  return n.norm() > 0.5 ? Vec3(n.normalized()) : Vec3::Zero();
}

/// Twice the spacing of `count` points within `radius` of one: neighbours on a surface are hardly ever farther.
double reach_for(double count, double radius, double scale, const Space& space) {
  const double spacing = space.is_2d() ? 2.0 * radius / count : radius * std::sqrt(kPi / count);
  return std::clamp(2.0 * spacing, kLeastReach * scale, kMostReach * scale);
}

double least_count(const Space& space) { return space.is_2d() ? 4 : 8; }

bool reliable(const PlaneFit& fit, double count, const Space& space) {
  const double spread = space.is_2d() ? fit.spread_u : fit.spread_v;
  return spread > 1e-6 * fit.spread_u && fit.rms * fit.rms <= kFlattest * spread * spread &&
         fit.rms <= kNormalError * spread * std::sqrt(count);
}

}  // namespace

NormalVerdict compare_normal(const Cells& cells, std::size_t voxel, const Vec3& normal) {
  const Vec3& n = cells.normal[voxel];
  const double variation = cells.variation[voxel];
  if (n.isZero() || variation - std::floor(variation) > kProves) return NormalVerdict::unknown;
  return std::abs(n.dot(normal)) >= kCompatible ? NormalVerdict::agrees : NormalVerdict::contradicts;
}

Cells estimate_normals(VoxelGrid& grid, const Space& space, Context& context) {
  std::vector<Level> levels(kLevels);
  for (int l = 1; l < kLevels; ++l) {
    const VoxelGrid& finer = l == 1 ? grid : levels[l - 1].grid;
    std::vector<int> up;
    levels[l].grid = finer.coarser(up, context);
    if (l == 1) {
      levels[l].parent = std::move(up);
    } else {
      levels[l].parent.resize(grid.size());
      for (std::size_t i = 0; i < grid.size(); ++i) levels[l].parent[i] = up[levels[l - 1].parent[i]];
    }
  }
  Cells cells;
  cells.normal.assign(grid.size(), Vec3::Zero());
  cells.variation.assign(grid.size(), 1.0);
  cells.tolerance.assign(grid.size(), grid.tolerance);
  cells.reach.assign(grid.size(), kLeastReach * 2.0 * grid.edge);
  parallel_blocks(context, grid.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& center = grid.moments[i].mean;
      for (int l = 0; l < kLevels; ++l) {
        const VoxelGrid& g = l == 0 ? grid : levels[l].grid;
        const Moments m = gather(g, l == 0 ? i : levels[l].parent[i], center, 2.0 * g.edge);
        if (m.count < least_count(space)) continue;
        if (l > 0) cells.reach[i] = reach_for(m.count, 2.0 * g.edge, 2.0 * grid.edge, space);
        const PlaneFit fit = fit_plane(m, space);
        if (!reliable(fit, m.count, space)) continue;
        cells.normal[i] = fit.normal;
        const double rms2 = fit.rms * fit.rms;
        // Coarser neighbourhoods come later: their flatness hides more.
        cells.variation[i] = l + rms2 / (rms2 + fit.spread_u * fit.spread_u + fit.spread_v * fit.spread_v);
        break;
      }
      if (cells.normal[i].isZero() && !grid.normals.empty()) {
        cells.normal[i] = input_normal(grid.normals[i].cast<double>(), space);
        if (!cells.normal[i].isZero()) cells.variation[i] = kLevels + 0.5;  // proves nothing
      }
    }
  });
  std::vector<int> reach(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) reach[i] = voxels_within(cells, grid, i, kBeyondReach);
  grid.find_farther(reach, context);
  return cells;
}

void adapt_tolerance(Cells& cells, const VoxelGrid& grid, const std::optional<Vec3>& viewpoint) {
  std::vector<double> factor(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Moments& m = grid.moments[i];
    factor[i] = viewpoint ? (m.mean - *viewpoint).norm()
                          : std::sqrt(std::max(0.0, cells.normal[i].dot(m.scatter * cells.normal[i])) / m.count);
  }
  const double usual = median(factor);
  if (!(usual > 0.0)) return;
  for (std::size_t i = 0; i < grid.size(); ++i)
    cells.tolerance[i] = grid.tolerance * std::clamp(factor[i] / usual, 1.0, 4.0);
}

}  // namespace unseen::planes
