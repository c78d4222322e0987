// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <memory>
#include <span>

#include "planes/arrange.h"

namespace unseen::planes {

/// Lets the model's parts grow over voxels that no patch took (where planes meet, normals are not reliable) while
/// these lie on the part's plane within half the scale and their normals do not contradict it.
void extend_parts(Model& model, const VoxelGrid& grid, const Cells& cells, const Context& context);

/// Makes one of the parts of a surface that adjoin since they grew, as a wall does across the end of another one, and parts of their own of pieces of one
/// that lie far from each other.
void join_parts(Model& model, const VoxelGrid& grid, const Cells& cells, const Context& context);

/// A plane that a voxel's points may belong to, and whether the voxel's own normal speaks for it.
struct ReachedPlane {
  std::int32_t plane;
  NormalVerdict normal;
};

/// Which planes each voxel's points can belong to, and where those end.
struct Reach {
  std::vector<Plane> planes;
  std::vector<double> noise;            ///< m, rms of each plane's surface
  std::vector<std::uint32_t> first;     ///< per voxel: where its candidates start; one longer than the voxels
  std::vector<ReachedPlane> candidate;  ///< by plane within a voxel
  /// Per voxel with k > 1 candidates, k×k signs from first_side: on which side of candidate b candidate a lies
  /// around here (+1, −1), or 0 if on both.
  std::vector<std::int8_t> side;
  std::vector<std::uint32_t> first_side;
  LargeVector<double> tolerance;  ///< m, per voxel: a point farther than this has no plane
  bool use_point_normals = false;
};

/// A plane reaches a voxel if one of its supporting voxels lies within about the scale of it.
Reach find_reach(const Model& model, const VoxelGrid& grid, const Cells& cells, bool use_point_normals,
                 const Context& context);

/// Takes over the model's planes after a refit: which voxels they reach stays as it was.
void update_planes(Reach& reach, const Model& model);

/// Plane of each point of a block: among those that reach it, and that its voxel's normal or its own does not
/// contradict (45°), first those that do not end before it at another plane, then those that the normals speak
/// for, then the nearest; −1 = none, or not in the grid's box. With `only_sure`, those of the first rank alone.
void assign_points(const Reach& reach, const VoxelGrid& grid, const PointCloud& block, bool only_sure,
                   std::span<int> plane_of_point, const Context& context);

/// Takes the plane from points that would bias a fit to it: those near where it meets another one of their voxel, within twice the noise,
/// as whose they are is a toss-up, and those farther from it than six times its noise, which lie on or over it.
void drop_doubtful(const Reach& reach, const VoxelGrid& grid, const PointCloud& block,
                     std::span<int> plane_of_point, const Context& context);

__extension__ using Int128 = __int128;

/// Moments of the points assigned to each plane, in integers so that their order does not matter.
class PlaneSums {
 public:
  PlaneSums(const Model& model, double scale);
  /// Adds a block's points, except those for which skip[first + i] is set (empty = none).
  void add(const PointCloud& block, std::span<const int> plane_of_point, const std::vector<bool>& skip,
           std::size_t first = 0);
  Moments moments(std::size_t plane) const;

 private:
  struct Sums {
    std::int64_t count = 0;
    std::array<std::int64_t, 3> first{};
    std::array<Int128, 6> second{};
  };
  double step_;
  std::vector<Vec3> origin_;
  std::vector<Sums> sums_;
};

}  // namespace unseen::planes
