// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// Points of a surface that can be asked for the nearest.
class SampledSurface {
 public:
  /// Without normals they are fitted to neighbouring points; their sign is open.
  explicit SampledSurface(std::vector<Vec3> points, std::vector<Vec3> normals = {});
  ~SampledSurface();
  SampledSurface(const SampledSurface&) = delete;
  SampledSurface& operator=(const SampledSurface&) = delete;

  /// Index of the point nearest to `p`; none if it is farther than `within` (m).
  std::optional<int> nearest(const Vec3& p, double within) const;
  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Vec3>& normals() const { return normals_; }

 private:
  struct Tree;
  std::vector<Vec3> points_, normals_;
  std::unique_ptr<Tree> tree_;
};

struct Registration {
  RigidTransform T_target_source;
  double rms = 0;      ///< m, of the matched points from the surface
  double matched = 0;  ///< share of the source points that found a partner
};

/// Iterated closest points between a cloud and a surface that both stand upright: turns about z and moves (Chen and
/// Medioni, "Object modelling by registration of multiple range images", 1992; distances to planes, and a little to
/// points so that nothing slides on a plane). Partners lie within `reach` (m) at first and within a quarter of it at last.
Registration register_upright(const std::vector<Vec3>& source, const SampledSurface& target, const RigidTransform& start, double reach);

/// At most `count` of the points, evenly taken.
std::vector<Vec3> every_nth(const std::vector<Vec3>& points, std::size_t count);

}  // namespace unseen::cuboids
