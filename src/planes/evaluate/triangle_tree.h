// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "unseen/core/mesh.h"

namespace unseen::planes {

/// The nearest point of triangle (a, b, c) to p.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Bounding-box tree over the triangles of a mesh that have an area. Keeps its own copy of them, in double
/// precision, so that survey coordinates lose nothing.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  bool empty() const { return triangles_.empty(); }

  struct Hit {
    Vec3 point, normal;        ///< nearest point of the surface, and the unit normal there
    double distance = 0;       ///< m
    std::size_t triangle = 0;  ///< index into the mesh
  };
  /// The nearest triangle; the lowest index among equals. The tree must not be empty.
  Hit nearest(const Vec3& p) const;

  /// True if two triangles within `radius` of p have normals that differ, signs aside, by more than `angle`
  /// (rad).
  bool normals_differ(const Vec3& p, double radius, double angle) const;

 private:
  struct Triangle {
    Vec3 a, b, c, normal;
    std::size_t index;
  };
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t begin = 0, end = 0;  ///< triangles of a leaf
    std::uint32_t right = 0;           ///< second child; the first follows its parent. 0 = leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace unseen::planes
