// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <limits>

#include "collision/orientations/views.h"
#include "collision/solve/contact.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kMostVertices = 128;  // of a hull: contacts between rounder shapes differ by less than is ever seen

std::vector<Vec3> thinned(const std::vector<Vec3>& vertices) {
  if (vertices.size() <= kMostVertices) return vertices;
  std::vector<char> kept(vertices.size(), 0);
  for (const Vec3& d : sphere_directions(2 * static_cast<int>(kMostVertices))) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i)
      if (vertices[i].dot(d) > vertices[best].dot(d)) best = i;
    kept[best] = 1;
  }
  std::vector<Vec3> few;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (kept[i]) few.push_back(vertices[i]);
  return few;
}

bool same_direction(const Vec3& a, const Vec3& b) { return a.dot(b) > 1.0 - 1e-8; }

/// The faces' outward normals; zero for a face without an area.
std::vector<Vec3> face_normals(const btConvexHullComputer& computer, const std::vector<Vec3>& vertices) {
  std::vector<Vec3> normals;
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    Vec3 normal = Vec3::Zero(), previous = Vec3::Zero();
    const Vec3 origin = vertices[first->getSourceVertex()];
    const auto* edge = first;
    do {
      const Vec3 corner = vertices[edge->getTargetVertex()] - origin;
      normal += previous.cross(corner);
      previous = corner;
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    if (normal.norm() < std::numeric_limits<double>::min()) {
      normals.push_back(Vec3::Zero());
      continue;
    }
    normal.normalize();
    // outwards, whichever way the faces run
    double low = 0.0, high = 0.0;
    for (const Vec3& v : vertices) low = std::min(low, normal.dot(v - origin)), high = std::max(high, normal.dot(v - origin));
    normals.push_back(high > -low ? Vec3(-normal) : normal);
  }
  return normals;
}

/// The face that each directed edge belongs to.
std::vector<std::size_t> faces_of_edges(const btConvexHullComputer& computer) {
  std::vector<std::size_t> faces(static_cast<std::size_t>(computer.edges.size()));
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    const auto* edge = first;
    do {
      faces[static_cast<std::size_t>(edge - &computer.edges[0])] = static_cast<std::size_t>(f);
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
  }
  return faces;
}

}  // namespace

Hull hull_of(const std::vector<Vec3>& points) {
  Hull hull;
  std::vector<double> flat;
  for (const Vec3& p : points) flat.insert(flat.end(), {p.x(), p.y(), p.z()});
  btConvexHullComputer computer;
  computer.compute(flat.data(), 3 * sizeof(double), static_cast<int>(points.size()), 0.0, 0.0);
  for (int i = 0; i < computer.vertices.size(); ++i)
    hull.vertices.push_back({computer.vertices[i].x(), computer.vertices[i].y(), computer.vertices[i].z()});
  const std::vector<Vec3> normals = face_normals(computer, hull.vertices);
  for (const Vec3& n : normals)
    if (!n.isZero() && std::none_of(hull.normals.begin(), hull.normals.end(), [&](const Vec3& m) { return same_direction(m, n); })) hull.normals.push_back(n);
  const std::vector<std::size_t> faces = faces_of_edges(computer);
  for (int e = 0; e < computer.edges.size(); ++e) {
    const auto &edge = computer.edges[e], &back = *edge.getReverseEdge();
    if (edge.getSourceVertex() > edge.getTargetVertex()) continue;  // each once
    const Vec3 &left = normals[faces[static_cast<std::size_t>(e)]], &right = normals[faces[static_cast<std::size_t>(&back - &computer.edges[0])]];
    if (left.isZero() || right.isZero() || same_direction(left, right)) continue;
    const Vec3 &from = hull.vertices[edge.getSourceVertex()], along = (hull.vertices[edge.getTargetVertex()] - from).normalized();
    hull.edges.push_back({from, along.dot(left.cross(right)) > 0.0 ? along : Vec3(-along), left, right});
  }
  return hull;
}

Solid solid_of(const Body& body, const std::string& source) {
  Solid solid;
  solid.mass = mass_properties(body, source);
  solid.file_to_principal = Quat(Mat3(solid.mass.axes.transpose()));
  solid.known_shape = body.shape == Shape::mesh || body.shape == Shape::box || body.shape == Shape::sphere;
  if (body.shape == Shape::sphere) solid.radius = body.radius;
  std::vector<Vec3> corners;
  if (body.shape == Shape::box)
    for (int i = 0; i < 8; ++i) corners.push_back(0.5 * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(body.box));
  if (body.shape == Shape::mesh)
    for (const Vec3& v : hull_of(body.mesh.vertices).vertices) corners.push_back(solid.file_to_principal * (v - solid.mass.center));
  if (!corners.empty()) solid.hull = hull_of(thinned(corners));
  return solid;
}

}  // namespace unseen::collision
