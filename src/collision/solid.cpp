// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <limits>

#include "collision/contact.h"
#include "collision/views.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kMostVertices = 64;  // of a hull: contacts between rounder shapes differ by less than is ever seen

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

void add_direction(std::vector<Vec3>& all, const Vec3& d, bool signed_) {
  constexpr double kSame = 1.0 - 1e-8;
  for (const Vec3& other : all)
    if ((signed_ ? d.dot(other) : std::abs(d.dot(other))) > kSame) return;
  all.push_back(d);
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
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    Vec3 normal = Vec3::Zero(), previous = Vec3::Zero();
    const Vec3 origin = hull.vertices[first->getSourceVertex()];
    const auto* edge = first;
    do {
      const Vec3 corner = hull.vertices[edge->getTargetVertex()] - origin;
      normal += previous.cross(corner);
      previous = corner;
      add_direction(hull.edges, (hull.vertices[edge->getTargetVertex()] - hull.vertices[edge->getSourceVertex()]).normalized(), false);
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    if (normal.norm() < std::numeric_limits<double>::min()) continue;
    normal.normalize();
    // outwards, whichever way the faces run
    double low = 0.0, high = 0.0;
    for (const Vec3& v : hull.vertices) low = std::min(low, normal.dot(v - origin)), high = std::max(high, normal.dot(v - origin));
    add_direction(hull.normals, high > -low ? Vec3(-normal) : normal, true);
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
