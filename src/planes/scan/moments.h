// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <optional>

#include "unseen/core/geometry.h"

namespace unseen::planes {

/// The space that planes are sought in: all of 3D, or a drawing, whose points share one coordinate, or nearly. In a
/// drawing a "plane" is a line; its normal is orthogonal to `flat_axis`.
struct Space {
  std::optional<Vec3> flat_axis;
  double flat_at = 0;  ///< m, that coordinate

  bool is_2d() const { return flat_axis.has_value(); }
  /// The part of `v` that a normal may have.
  Vec3 admissible(const Vec3& v) const { return flat_axis ? Vec3(v - v.dot(*flat_axis) * *flat_axis) : v; }
};

/// Zeroth, first and second moments of a set of points; sums of them are exact up to rounding.
struct Moments {
  double count = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 scatter = Mat3::Zero();  ///< Σ (p − mean)(p − mean)ᵀ, m²

  Moments& operator+=(const Moments& o) {
    if (o.count == 0) return *this;
    if (count == 0) return *this = o;
    const double total = count + o.count, share = o.count / total;
    const Vec3 d = o.mean - mean, e = count * share * d;
    for (int i = 0; i < 3; ++i) scatter.col(i) += o.scatter.col(i) + e[i] * d;
    mean += share * d;
    count = total;
    return *this;
  }
  friend Moments operator+(Moments a, const Moments& b) { return a += b; }

  /// Σ (n·p − offset)² over the points.
  double squared_distances(const Vec3& n, double offset) const {
    const double d = n.dot(mean) - offset;
    return n.dot(scatter * n) + count * d * d;
  }
};

/// Least-squares plane through a set of points, with its spread.
struct PlaneFit {
  Vec3 normal = Vec3::UnitZ();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();  ///< in-plane principal axes, longest first
  double rms = 0;                             ///< m, across the plane
  double spread_u = 0, spread_v = 0;          ///< m, standard deviation along u and v (2D: v is the flat axis, 0)
};

PlaneFit fit_plane(const Moments& m, const Space& space);

}  // namespace unseen::planes
