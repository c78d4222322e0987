// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "unseen/report/point_sample.h"

namespace unseen::report {

/// The points of a sample by plane, and along a space-filling curve within each, so that neighbours in the order are
/// neighbours in space: such points pack well.
struct OrderedPoints {
  std::vector<Vec3> positions;
  std::vector<int> plane;          ///< ascending from −1
  std::vector<std::size_t> first;  ///< where each plane starts; one longer than the planes

  std::span<const Vec3> of_plane(int p) const { return std::span(positions).subspan(first[p], first[p + 1] - first[p]); }
};

OrderedPoints ordered(const PointSample& sample, std::size_t plane_count);

/// Least-squares plane through points; in a drawing its normal is orthogonal to the axis `flat`. Its sign is arbitrary.
Plane fitted_plane(std::span<const Vec3> points, std::optional<int> flat);

/// Normals of some thousand small groups of neighbouring points: what the input says of orientations, before
/// anything is made regular.
std::vector<Vec3> local_normals(const OrderedPoints& points, std::optional<int> flat);

}  // namespace unseen::report
