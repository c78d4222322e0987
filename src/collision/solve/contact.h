// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision/solve/mass_properties.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// An edge between two faces of a polytope.
struct HullEdge {
  Vec3 from;         ///< m, one of its ends
  Vec3 direction;    ///< unit, along left × right
  Vec3 left, right;  ///< outward normals of the two faces
};

/// A convex polytope by what a contact with it can have as its normal.
struct Hull {
  std::vector<Vec3> vertices;   ///< m
  std::vector<Vec3> normals;    ///< of the faces, outwards, each direction once
  std::vector<HullEdge> edges;  ///< each once
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

/// How the normal (from b to a) follows the bodies while the same features touch. Directions and points are in the principal frames.
struct ContactLaw {
  enum class Kind { constant, level, face_a, face_b, edges, centers };
  Kind kind = Kind::constant;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  ///< the constant normal (a; a level one is up); the face's outward one; both edges; two points, the normal leads from b to a
  Vec3 edge = Vec3::Zero();                 ///< of points: part that is left out, along the edge of whichever body is no sphere
  double sign = 1;                          ///< of edges
};

/// A face of the Minkowski difference of two solids that are turned as they are: a way in which they can touch.
struct MinkowskiFace {
  Vec3 normal;       ///< unit, from the second body to the first
  double reach = 0;  ///< m: how far apart the centres are along the normal when the bodies touch, without the radii of spheres
  ContactLaw law;
};

/// What touches of one body: a corner, an edge or a face.
struct Feature {
  Vec3 point = Vec3::Zero();     ///< on the surface, at the contact
  Mat3 axes = Mat3::Identity();  ///< the first is the normal
  Vec3 extent = Vec3::Zero();    ///< m: how far the contact may be from the point, along the axes
};

/// Where two solids are nearest, or penetrate least: a separating axis that a touching contact can have (Gottschalk et al. 1996).
/// Other shapes than spheres are taken as convex.
struct Proximity {
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< on the surfaces
  Vec3 normal = Vec3::UnitZ();  ///< unit, from b to a
  double gap = 0;               ///< m, negative inside
  ContactLaw law;
  std::array<Feature, 2> features;  ///< of polytopes
};

/// `tolerance` (m): what is that near counts as touching. Nothing if a shape is unknown.
std::optional<Proximity> nearest(const Solid& a, const Vec3& p_a, const Quat& q_a, const Solid& b, const Vec3& p_b, const Quat& q_b,
                               double tolerance);

/// The same where the normal is known already.
Proximity contact_along(const Solid& a, const Vec3& p_a, const Quat& q_a, const Solid& b, const Vec3& p_b, const Quat& q_b, const MinkowskiFace& face,
                        double tolerance);

/// The same for a solid and a plane somewhere behind it, of which only the normal is known: the gap is 0.
Proximity nearest_to_plane(const Solid& a, const Vec3& p_a, const Quat& q_a, const Vec3& normal, double tolerance);

}  // namespace unseen::collision
