// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/mesh.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A convex solid: outward faces as loops of vertex indices, and the distinct directions of edges.
struct ConvexSolid {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;  ///< counter-clockwise from outside
  std::vector<Plane> planes;            ///< of each face, normal outward
  std::vector<std::array<int, 2>> edges;
  std::vector<Vec3> edge_directions;  ///< unit, without doubles (parallel ones count once)
  Vec3 center = Vec3::Zero();         ///< of a sphere around it
  double radius = 0;                  ///< m
};
ConvexSolid solid_of(const OrientedBox& box);
/// Coplanar triangles become one face; a mesh that is inside out is turned. Throws std::invalid_argument if it is not
/// closed, not convex (by more than 1e-5 of its radius) or has no volume.
ConvexSolid solid_of(const TriangleMesh& mesh);

/// Where two bodies meet.
struct Interface {
  Vec3 normal = Vec3::UnitZ();  ///< from a to b
  double gap = 0;               ///< m, smallest distance along the normal; negative = they overlap by that much
  std::vector<Vec3> points;     ///< 1 (point), 2 (edge) or 3 to 8 (corners of the common face; 4 for aligned boxes)
  std::vector<double> gaps;     ///< m, between the surfaces at each of them
};

/// The interface of two convex solids that come within `tolerance` of each other; none if they are farther apart.
///
/// Separating axes: faces of both, cross products of edges; the one with the largest gap is the normal (edges only if
/// they win by more than `tolerance`). A negative gap is the depth of their overlap, of any size.
///
/// Of the face that looks at the other body's face, that part is in contact which lies no more than 2·`tolerance`
/// farther off than its nearest point: measured faces err by `tolerance` either way, so at 8 mm a face of 0.2 m that
/// is fitted 4.6° askew still rests as a whole, while a truly tilted exact block (tolerance 1e-6) rests on its edge.
/// Beyond 20° of tilt, or if the part is narrower than 5 % of the face, it is the edge or the corner.
/// A common area that is narrower than `tolerance` and than a quarter of both faces is no contact: boxes that meet
/// only at the corner of a grid carry nothing. Parallel edges whose faces do not face each other, as in a card house,
/// touch along an edge: no face is preferred, the normal lies half-way. Points lie half-way between the two surfaces.
std::optional<Interface> interface_of(const ConvexSolid& a, const ConvexSolid& b, double tolerance);
/// The same with a support: its half space behind the plane; or, if it has an outline, what is behind that (widened by `tolerance`), but
/// bodies behind it altogether do not meet it.
std::optional<Interface> interface_of(const Support& a, const ConvexSolid& b, double tolerance);

}  // namespace unseen::cuboids
