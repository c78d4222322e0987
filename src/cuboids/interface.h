// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/mesh.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A convex solid: outward faces as loops of vertex indices, and the distinct directions of faces and edges.
struct ConvexSolid {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;  ///< counter-clockwise from outside
  std::vector<Plane> planes;            ///< of each face, normal outward
  std::vector<Vec3> edge_directions;    ///< without doubles (parallel ones count once)
};
ConvexSolid solid_of(const OrientedBox& box);
/// Coplanar triangles become one face. Throws std::invalid_argument if it is not closed or not convex.
ConvexSolid solid_of(const TriangleMesh& mesh);

/// Where two bodies meet: 1, 2 or 4 points (more are thinned to the 4 that span the overlap best).
struct Interface {
  Vec3 normal = Vec3::UnitZ();  ///< from a to b
  double gap = 0;               ///< m, smallest distance along the normal; negative = they overlap by that much
  std::vector<Vec3> points;
};

/// The interface of two convex solids that come within `tolerance` of each other (and overlap at most by the depth
/// that the separating axis says); none if they are farther apart. Separating axes: faces of both, cross products of
/// edges; the axis with the largest gap decides whether it is face–face (overlap clipped), edge–edge or vertex–face.
std::optional<Interface> interface_of(const ConvexSolid& a, const ConvexSolid& b, double tolerance);
/// The same with a support: its half space behind the plane, within the outline if it has one.
std::optional<Interface> interface_of(const Support& a, const ConvexSolid& b, double tolerance);

}  // namespace unseen::cuboids
