// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <memory>
#include <span>

#include "planes/arrange.h"

namespace unseen::planes {

/// A plane that a voxel's points may belong to, and whether the voxel's own normal speaks for it.
struct ReachedPlane {
  std::int32_t plane;
  enum Normal : std::int8_t { agrees, unknown, contradicts } normal;
};

/// Which planes each voxel's points can belong to.
struct Reach {
  std::vector<Plane> planes;
  std::vector<std::uint32_t> first;     ///< per voxel: where its candidates start; one longer than the voxels
  std::vector<ReachedPlane> candidate;  ///< by plane within a voxel
  std::vector<double> tolerance;        ///< m, per voxel: a point farther than this has no plane
  bool use_point_normals = false;
};

/// A plane reaches a voxel if one of its supporting voxels lies within about the scale of it.
Reach find_reach(const Model& model, const VoxelGrid& grid, const Cells& cells, bool use_point_normals,
                 const Context& context);

/// Plane of each point of a block: the nearest that reaches it and with which the voxel's normal or its own is
/// compatible (45°), else the nearest where the voxel has no normal; −1 = none, or not finite.
void assign_points(const Reach& reach, const VoxelGrid& grid, const PointCloud& block, std::span<int> plane_of_point,
                   const Context& context);

__extension__ using Int128 = __int128;

/// Moments of the points assigned to each plane, in integers so that their order does not matter.
class PlaneSums {
 public:
  PlaneSums(const Model& model, double scale);
  void add(const PointCloud& block, std::span<const int> plane_of_point, const std::vector<bool>& skip);
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
