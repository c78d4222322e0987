// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/minkowski.h"

#include <algorithm>
#include <limits>

namespace unseen::collision {
namespace {

constexpr double kParallel = 1e-3;  // sine of the angle between edges: there faces tell

/// How far a polytope about the origin reaches along `n`.
double support(const std::vector<Vec3>& vertices, const Vec3& n) {
  double most = vertices.empty() ? 0.0 : -std::numeric_limits<double>::infinity();
  for (const Vec3& v : vertices) most = std::max(most, n.dot(v));
  return most;
}

std::vector<Vec3> turned(const std::vector<Vec3>& vectors, const Mat3& R) {
  std::vector<Vec3> all;
  all.reserve(vectors.size());
  for (const Vec3& v : vectors) all.push_back(R * v);
  return all;
}

std::vector<HullEdge> turned(const std::vector<HullEdge>& edges, const Mat3& R) {
  std::vector<HullEdge> all;
  all.reserve(edges.size());
  for (const HullEdge& e : edges) all.push_back({R * e.from, R * e.direction, R * e.left, R * e.right});
  return all;
}

/// Whether the arc between the normals beside the edge of b crosses that of a, mirrored: only then do the edges touch.
bool arcs_cross(const HullEdge& a, const HullEdge& b) {
  const double left = b.left.dot(a.direction), right = b.right.dot(a.direction);
  if (left * right >= 0.0) return false;
  const double first = a.left.dot(b.direction), second = a.right.dot(b.direction);
  return first * second < 0.0 && left * second < 0.0;
}

}  // namespace

std::vector<MinkowskiFace> minkowski_faces(const Hull& a, const Quat& q_a, const Hull& b, const Quat& q_b) {
  using Kind = ContactLaw::Kind;
  const Mat3 turn_a = q_a.toRotationMatrix(), turn_b = q_b.toRotationMatrix();
  const std::vector<Vec3> corners_a = turned(a.vertices, turn_a), corners_b = turned(b.vertices, turn_b);
  std::vector<MinkowskiFace> faces;
  const auto add_face = [&](const Vec3& n, Kind kind, const Vec3& of_a, const Vec3& of_b) {
    faces.push_back({n, support(corners_b, n) + support(corners_a, -n), {kind, of_a, of_b, Vec3::Zero(), 1.0}});
  };
  for (const Vec3& n : b.normals) add_face(turn_b * n, Kind::face_b, Vec3::Zero(), n);
  for (const Vec3& n : a.normals) add_face(-(turn_a * n), Kind::face_a, n, Vec3::Zero());
  const std::vector<HullEdge> edges_a = turned(a.edges, turn_a), edges_b = turned(b.edges, turn_b);
  for (std::size_t i = 0; i < edges_a.size(); ++i)
    for (std::size_t j = 0; j < edges_b.size(); ++j) {
      const HullEdge &u = edges_a[i], &v = edges_b[j];
      if (!arcs_cross(u, v)) continue;
      const Vec3 across = u.direction.cross(v.direction);
      const double sine = across.norm();
      if (sine < kParallel) continue;
      const double sign = across.dot(v.left + v.right) > 0.0 ? 1.0 : -1.0;
      const Vec3 n = (sign / sine) * across;
      faces.push_back({n, n.dot(v.from - u.from), {Kind::edges, a.edges[i].direction, b.edges[j].direction, Vec3::Zero(), sign}});
    }
  return faces;
}

std::vector<MinkowskiFace> round_faces(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b, const Vec3& apart) {
  const bool first = a.is_sphere();
  const Solid& other = first ? b : a;
  const Quat& q = first ? q_b : q_a;
  const double sign = first ? 1.0 : -1.0;
  const Vec3 center = q.conjugate() * (sign * apart);  // of the sphere, as the other body has it
  std::vector<MinkowskiFace> faces;
  const auto add = [&](const Vec3& off, const Vec3& corner, const Vec3& edge) {
    if (off.norm() < 1e-12) return;
    const Vec3 outward = off.normalized(), none = Vec3::Zero();
    faces.push_back({sign * (q * outward), support(other.hull.vertices, outward), {ContactLaw::Kind::centers, first ? none : corner, first ? corner : none, edge, 1.0}});
  };
  if (other.is_sphere()) add(center, Vec3::Zero(), Vec3::Zero());
  for (const Vec3& v : other.hull.vertices) add(center - v, v, Vec3::Zero());
  for (const HullEdge& e : other.hull.edges) {
    const Vec3 off = center - e.from;
    add(off - e.direction * e.direction.dot(off), e.from, e.direction);
  }
  return faces;
}

}  // namespace unseen::collision
