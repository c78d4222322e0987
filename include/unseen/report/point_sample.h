// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::report {

/// An even share of a stream of points with their planes, small enough to draw: every k-th finite point, k a
/// power of two that doubles whenever `limit` is reached. The same stream gives the same sample.
struct PointSample {
  std::size_t limit = 5'000'000;
  std::vector<Vec3> positions;
  std::vector<int> plane_of_point;  ///< −1 = none; as long as `positions`
  std::size_t step = 1;             ///< k
  std::size_t seen = 0;             ///< finite points so far

  /// Takes a block, as an AssignmentSink gets it.
  void add(std::span<const Vec3> block, std::span<const int> planes);
};

/// An even share of a sample.
PointSample thinned(const PointSample& sample, std::size_t limit);

}  // namespace unseen::report
