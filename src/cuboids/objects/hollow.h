// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// The least polytope with 34 sides of given directions around points: nearly their convex hull, above all where they are turned about the third axis.
class Hull {
 public:
  void add(const Vec3& p) {
    const Heights h = heights(p);
    low_ = low_.min(h);
    high_ = high_.max(h);
  }
  void add(const Hull& other) {
    low_ = low_.min(other.low_);
    high_ = high_.max(other.high_);
  }
  bool contains(const Vec3& p) const {
    const Heights h = heights(p);
    return (h > low_).all() && (h < high_).all();
  }

 private:
  using Heights = Eigen::Array<double, 17, 1>;
  static Heights heights(const Vec3& p) {
    const double x = p.x(), y = p.y(), z = p.z(), s = 0.41421356;  // tangent of 22.5 degrees
    Heights h;
    h << x, y, z, x + y, x - y, x + s * y, x - s * y, s * x + y, s * x - y, x + z, x - z, y + z, y - z, x + y + z, x + y - z, x - y + z, x - y - z;
    return h;
  }
  Heights low_ = Heights::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

/// What was seen of the space within the hull of a part.
struct Interior {
  Mat3 axes;                           ///< of the hull's main directions, as columns
  std::span<const int> face_of_point;  ///< −1 = none: what flies about an edge spans no hull
  std::vector<Vec3> cells;             ///< centres, in the coordinates of the axes
  std::vector<char> is_free;           ///< of a cell: seen free, also half a pixel aside, and farther before any surface than its noise and warps reach
};

Interior look_into(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const int> face_of_point, const Mat3& axes);

/// How many cells of an interior are within a hull.
struct Hollow {
  double within = 0, free = 0;
  double share() const { return within > 0.0 ? free / within : 0.0; }
};
Hollow hollow_of(const Interior& interior, const Hull& hull);

/// Some of the points.
struct Piece {
  std::vector<int> points;
  Hollow hollow;
};
Piece piece_of(const Observation& seen, const Interior& interior, std::vector<int> points);

/// Points of a piece that lie together on one face are one clump: what takes long is tried with these.
struct Clumps {
  std::vector<Vec3> centers;  ///< world
  std::vector<Hull> hulls;
  std::vector<int> counts;  ///< of points
  std::vector<std::vector<int>> neighbours;
};
Clumps clumps_of(const Observation& seen, const Interior& interior, std::span<const int> points);

}  // namespace unseen::cuboids
