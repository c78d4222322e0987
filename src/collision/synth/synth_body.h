// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/collision/types.h"
#include "unseen/core/random.h"

namespace unseen::collision {

/// A convex body of the simulator: its surface about the centre of mass, in the file's axes, and its inertia.
struct SynthBody {
  struct Face {
    Vec3 normal;                ///< unit, outwards
    double offset = 0;          ///< of its plane, m
    std::vector<int> corners;   ///< indices into vertices, in no order
  };
  struct Edge {
    int from = 0, to = 0;       ///< indices into vertices
    Vec3 normals[2];            ///< of the two faces
  };

  double radius = 0;            ///< of a sphere, which has no vertices; 0 = polyhedron
  std::vector<Vec3> vertices;   ///< m
  std::vector<Face> faces;
  std::vector<Edge> edges;      ///< between faces that are not coplanar
  Vec3 center = Vec3::Zero();   ///< of mass, in the file's axes, m
  Mat3 inertia = Mat3::Zero();  ///< of unit mass about the centre, file's axes, m²
  double reach = 0;             ///< largest distance of the surface from the centre, m

  bool sphere() const { return radius > 0; }
};

/// Box, sphere, or closed convex mesh.
SynthBody synth_body(const Body& body);

/// A closed convex mesh with outward triangles, its origin not at its centre of mass: a hexagonal prism, a wedge or a frustum.
TriangleMesh synth_mesh(Random& random);

/// A body's place in the world: p is the centre of mass, q turns the file's axes into the world.
struct SynthPose {
  Vec3 p = Vec3::Zero();
  Quat q = Quat::Identity();
};

/// Gap between two convex bodies, m; negative where they overlap. Two polyhedra: the largest gap along the axes of the separating
/// axis theorem, exact in sign (Gottschalk, Lin, Manocha, "OBBTree", 1996); else the distance itself.
double separation(const SynthBody& a, const SynthPose& at, const SynthBody& b, const SynthPose& bt);

/// Height of the lowest point above a plane, and that point, m.
double separation(const SynthBody& a, const SynthPose& at, const Plane& floor, Vec3* lowest = nullptr);

}  // namespace unseen::collision
