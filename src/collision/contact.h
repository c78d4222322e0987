// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/mass_properties.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// A convex polytope by what a contact with it can have as its normal.
struct Hull {
  std::vector<Vec3> vertices;  ///< m
  std::vector<Vec3> normals;   ///< of the faces, outwards, each direction once
  std::vector<Vec3> edges;     ///< unit, each direction once, either way
};

Hull hull_of(const std::vector<Vec3>& points);

/// A body in its principal frame, centre of mass at the origin.
struct Solid {
  MassProperties mass;
  Quat file_to_principal = Quat::Identity();  ///< maps the file's axes to the principal ones
  Hull hull;                   ///< empty for a sphere
  double radius = 0;           ///< of a sphere
  bool known_shape = false;    ///< false: only its size is known, or it is fixed

  bool is_sphere() const { return known_shape && hull.vertices.empty(); }
};

/// Throws InputError as mass_properties does.
Solid solid_of(const Body& body, const std::string& source);

/// Where two solids are nearest, or penetrate least: a separating axis that a touching contact can have (Gottschalk et al. 1996).
/// Other shapes than spheres are taken as convex.
struct Proximity {
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< on the surfaces
  Vec3 normal = Vec3::UnitZ();  ///< unit, from b to a
  double gap = 0;               ///< m, negative inside
  Vec3 slack = Vec3::Zero();    ///< m: half extents, along the axes, within which the point may lie when surfaces meet along an edge or a face
  Mat3 axes = Mat3::Identity();  ///< first: the normal
};

/// `tolerance` (m): what is that near counts as touching. Nothing if a shape is unknown.
std::optional<Proximity> nearest(const Solid& a, const Vec3& p_a, const Quat& q_a, const Solid& b, const Vec3& p_b, const Quat& q_b,
                               double tolerance);

/// The same for a solid and a plane somewhere behind it, of which only the normal is known: the gap is 0.
Proximity nearest_to_plane(const Solid& a, const Vec3& p_a, const Quat& q_a, const Vec3& normal, double tolerance);

}  // namespace unseen::collision
