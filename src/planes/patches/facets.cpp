// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/patches/facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace unseen::planes {
namespace {

constexpr int kSides[] = {16, 24, 32};      // blocks along either side of the region: the finer ones where facets are many
constexpr double kFewestPoints = 12;        // in a block,
constexpr std::size_t kFewestBlocks = 40;   // and blocks;
constexpr double kThin = 0.05;              // points in a line tell no slope across it
constexpr double kBent = 4.0;               // times the variance about the blocks' planes, or of rounding: what one plane leaves
constexpr double kTurned = 0.02;            // rad: between facets, at least
constexpr double kNear = 0.3;               // of that: how far blocks of a facet may face from it
constexpr double kFewest = 0.06;            // of the points: in a facet's direction,
constexpr double kMost = 0.6;               // and in those of all
constexpr std::size_t kMostDirections = 6, kMostFacets = 100;
constexpr std::size_t kFewestOfFacet = 2;   // blocks
constexpr double kLeftOver = 0.3;           // of the squared error that the facets leave

/// A square of a region, and which way it faces.
struct Block {
  Moments sum;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< against the region's plane, along its axes
  double error = 0;                                 ///< m², squared, about its own plane
  bool known = false;
  int direction = -1, facet = -1;
};

/// A region as a grid of blocks over its plane.
struct Blocks {
  int side;
  std::vector<Block> at;      ///< side², row by row
  std::vector<int> of_voxel;  ///< parallel to the region
};

Blocks blocks_of(const VoxelGrid& grid, const std::vector<int>& region, const PlaneFit& fit, int side) {
  Eigen::AlignedBox2d box;
  std::vector<Eigen::Vector2d> places;
  for (const int i : region) {
    places.emplace_back(fit.u.dot(grid.moments[i].mean), fit.v.dot(grid.moments[i].mean));
    box.extend(places.back());
  }
  Blocks blocks{side, std::vector<Block>(static_cast<std::size_t>(side * side)), {}};
  const Eigen::Vector2d step = box.sizes().cwiseMax(1e-300) / side;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Eigen::Vector2d at = (places[i] - box.min()).cwiseQuotient(step);
    const int b = std::min(side - 1, static_cast<int>(at.x())) + side * std::min(side - 1, static_cast<int>(at.y()));
    blocks.of_voxel.push_back(b);
    blocks.at[b].sum += grid.moments[region[i]];
  }
  for (Block& b : blocks.at) {
    if (b.sum.count < kFewestPoints) continue;
    const std::optional<Slope> slope = slope_of(b.sum, fit);
    if (!slope) continue;
    b.slope = slope->slope;
    b.error = slope->error;
    b.known = true;
  }
  return blocks;
}

/// Names the directions that most blocks face, each the mean of blocks near to it; false if these are not most, or fewer than two, or not apart.
bool find_directions(std::vector<Block*>& known, double all) {
  constexpr double kReach = kNear * kTurned;
  std::vector<Eigen::Vector2d> directions;
  double faced = 0;
  while (directions.size() < kMostDirections) {
    Eigen::Vector2d best = Eigen::Vector2d::Zero();
    double most = 0;
    for (const Block* candidate : known) {
      if (candidate->direction >= 0) continue;
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      double count = 0;
      for (const Block* b : known)
        if (b->direction < 0 && (b->slope - candidate->slope).norm() < kReach) mean += b->sum.count * b->slope, count += b->sum.count;
      if (count > most) most = count, best = mean / count;
    }
    if (most < kFewest * all) break;
    double count = 0;
    for (Block* b : known)
      if (b->direction < 0 && (b->slope - best).norm() < kReach) b->direction = static_cast<int>(directions.size()), count += b->sum.count;
    if (!(count > 0.0)) break;
    for (const Eigen::Vector2d& d : directions)
      if ((d - best).norm() < kTurned) return false;
    directions.push_back(best);
    faced += count;
  }
  return directions.size() > 1 && faced > kMost * all;
}

/// Numbers the connected blocks of one direction; their moments.
std::vector<Moments> find_facets(Blocks& blocks) {
  const int side = blocks.side;
  std::vector<Moments> facets;
  for (int start = 0; start < side * side; ++start) {
    if (blocks.at[start].direction < 0 || blocks.at[start].facet >= 0) continue;
    std::vector<int> connected = {start};
    const int number = static_cast<int>(facets.size());
    blocks.at[start].facet = number;
    for (std::size_t k = 0; k < connected.size(); ++k) {
      const int x = connected[k] % side, y = connected[k] / side;
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || x + dx >= side || y + dy < 0 || y + dy >= side) continue;
        Block& next = blocks.at[connected[k] + dx + side * dy];
        if (next.direction != blocks.at[start].direction || next.facet >= 0) continue;
        next.facet = number;
        connected.push_back(connected[k] + dx + side * dy);
      }
    }
    Moments sum;
    for (const int b : connected) sum += blocks.at[b].sum;
    if (connected.size() < kFewestOfFacet)
      for (const int b : connected) blocks.at[b].direction = blocks.at[b].facet = -1;
    else
      facets.push_back(sum);
  }
  return facets;
}

/// The facet of each voxel: that of its block, or, across an edge, the nearest plane of those nearby.
std::vector<int> share_voxels(const VoxelGrid& grid, const std::vector<int>& region, const Blocks& blocks, const std::vector<Moments>& facets) {
  std::vector<PlaneFit> planes;
  for (const Moments& m : facets) planes.push_back(fit_plane(m, {}));
  const int side = blocks.side;
  std::vector<std::vector<int>> nearby(blocks.at.size());  // facets that a block's voxels may be of
  for (int b = 0; b < side * side; ++b)
    for (int reach = 0; reach < side && nearby[b].empty(); ++reach)
      for (int y = std::max(0, b / side - reach); y <= std::min(side - 1, b / side + reach); ++y)
        for (int x = std::max(0, b % side - reach); x <= std::min(side - 1, b % side + reach); ++x)
          if (const int facet = blocks.at[x + side * y].facet; facet >= 0) nearby[b].push_back(facet);
  std::vector<int> of_voxel;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const auto off = [&](int facet) { return std::abs(planes[facet].normal.dot(grid.moments[region[i]].mean - facets[facet].mean)); };
    const std::vector<int>& near = nearby[blocks.of_voxel[i]];
    of_voxel.push_back(*std::min_element(near.begin(), near.end(), [&](int a, int b) { return off(a) < off(b); }));
  }
  return of_voxel;
}

/// None if one plane leaves hardly more than the blocks' do.
std::optional<Facets> facets_of(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit, int side) {
  Blocks blocks = blocks_of(grid, region, fit, side);
  std::vector<Block*> known;
  double by_blocks = 0, count = 0;
  for (Block& b : blocks.at)
    if (b.known) known.push_back(&b), by_blocks += b.error, count += b.sum.count;
  const double error = squared_error(whole, {});
  const double noise = std::max(by_blocks / count, grid.rounding * grid.rounding / 12.0);
  if (known.size() < kFewestBlocks || error / whole.count < kBent * noise) return std::nullopt;
  if (!find_directions(known, count)) return Facets();
  const std::vector<Moments> facets = find_facets(blocks);
  if (facets.size() < 2 || facets.size() > kMostFacets) return Facets();
  const std::vector<int> facet_of_voxel = share_voxels(grid, region, blocks, facets);
  Facets result{CellSets(facets.size()), 0.0};
  std::vector<Moments> sums(facets.size());
  for (std::size_t i = 0; i < region.size(); ++i) {
    result.pieces[facet_of_voxel[i]].push_back(region[i]);
    sums[facet_of_voxel[i]] += grid.moments[region[i]];
  }
  for (const Moments& m : sums) result.error += squared_error(m, {});
  return result.error < kLeftOver * error ? result : Facets();
}

}  // namespace

std::optional<Slope> slope_of(const Moments& points, const PlaneFit& plane) {
  const Vec3 along_u = points.scatter * plane.u, along_v = points.scatter * plane.v;
  const double uu = plane.u.dot(along_u), uv = plane.v.dot(along_u), vv = plane.v.dot(along_v), uw = plane.normal.dot(along_u), vw = plane.normal.dot(along_v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > kThin * uu * vv)) return std::nullopt;
  const Eigen::Vector2d slope = Eigen::Vector2d(vv * uw - uv * vw, uu * vw - uv * uw) / determinant;
  return Slope{slope, plane.normal.dot(points.scatter * plane.normal) - slope.x() * uw - slope.y() * vw};
}

Facets facets_in(const VoxelGrid& grid, const std::vector<int>& region, const Moments& whole, const PlaneFit& fit) {
  for (const int side : kSides) {
    std::optional<Facets> facets = facets_of(grid, region, whole, fit, side);
    if (!facets) break;
    if (!facets->pieces.empty()) return *std::move(facets);
  }
  return {};
}

}  // namespace unseen::planes
