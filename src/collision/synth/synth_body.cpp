// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/synth/synth_body.h"

#include <algorithm>
#include <limits>
#include <map>

namespace unseen::collision {
namespace {

constexpr double kCoplanar = 1e-9;

TriangleMesh box_mesh(const Vec3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(0.5 * Vec3(i & 1 ? size.x() : -size.x(), i & 2 ? size.y() : -size.y(), i & 4 ? size.z() : -size.z()));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Centre and inertia as a sum over tetrahedra with their fourth corner at the origin. That of a tetrahedron's second moment:
/// V/20 (Σ v vᵀ + s sᵀ) over its corners v with sum s.
void weigh(const TriangleMesh& mesh, SynthBody& body) {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double v = a.dot(b.cross(c)) / 6;
    const Vec3 sum = a + b + c;
    volume += v;
    first += v / 4 * sum;
    second += v / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  body.center = first / volume;
  const Mat3 spread = second / volume - body.center * body.center.transpose();
  body.inertia = spread.trace() * Mat3::Identity() - spread;
}

/// Faces from coplanar triangles, edges where two faces meet.
void find_surface(const TriangleMesh& mesh, SynthBody& body) {
  std::vector<int> face_of;
  for (const Vec3& v : mesh.vertices) body.vertices.push_back(v - body.center);
  for (const auto& t : mesh.triangles) {
    const Vec3& a = body.vertices[t[0]];
    const Vec3 normal = (body.vertices[t[1]] - a).cross(body.vertices[t[2]] - a).normalized();
    const auto same = std::find_if(body.faces.begin(), body.faces.end(), [&](const auto& f) {
      return (f.normal - normal).norm() < kCoplanar && std::abs(f.offset - normal.dot(a)) < kCoplanar;
    });
    face_of.push_back(static_cast<int>(same - body.faces.begin()));
    if (same == body.faces.end()) body.faces.push_back({normal, normal.dot(a), {}});
    auto& corners = body.faces[static_cast<std::size_t>(face_of.back())].corners;
    for (const std::uint32_t v : t)
      if (std::find(corners.begin(), corners.end(), static_cast<int>(v)) == corners.end()) corners.push_back(static_cast<int>(v));
  }
  std::map<std::pair<int, int>, int> face_at;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      face_at[{static_cast<int>(mesh.triangles[i][k]), static_cast<int>(mesh.triangles[i][(k + 1) % 3])}] = face_of[i];
  for (const auto& [edge, face] : face_at) {
    const int other = face_at.at({edge.second, edge.first});
    if (edge.first < edge.second && other != face)
      body.edges.push_back({edge.first, edge.second,
                            {body.faces[static_cast<std::size_t>(face)].normal, body.faces[static_cast<std::size_t>(other)].normal}});
  }
}

/// Extent along an axis, both ways, of a body in the world.
std::pair<double, double> extent(const SynthBody& body, const SynthPose& pose, const Vec3& axis) {
  const Vec3 local = pose.q.conjugate() * axis;
  const double middle = axis.dot(pose.p);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& v : body.vertices) {
    const double d = local.dot(v);
    low = std::min(low, d);
    high = std::max(high, d);
  }
  return {middle + low, middle + high};
}

double gap_along(const Vec3& axis, const SynthBody& a, const SynthPose& at, const SynthBody& b, const SynthPose& bt) {
  const auto [a_low, a_high] = extent(a, at, axis);
  const auto [b_low, b_high] = extent(b, bt, axis);
  return std::max(b_low - a_high, a_low - b_high);
}

double polyhedra(const SynthBody& a, const SynthPose& at, const SynthBody& b, const SynthPose& bt) {
  double gap = -std::numeric_limits<double>::infinity();
  for (const auto& f : a.faces) gap = std::max(gap, gap_along(at.q * f.normal, a, at, b, bt));
  for (const auto& f : b.faces) gap = std::max(gap, gap_along(bt.q * f.normal, a, at, b, bt));
  for (const auto& e : a.edges)
    for (const auto& f : b.edges) {
      const Vec3 d = at.q * (a.vertices[e.to] - a.vertices[e.from]).normalized();
      const Vec3 axis = d.cross(bt.q * (b.vertices[f.to] - b.vertices[f.from]).normalized());
      if (axis.norm() > 1e-6) gap = std::max(gap, gap_along(axis.normalized(), a, at, b, bt));
    }
  return gap;
}

/// Distance of a point from the surface: negative inside. Outside, the nearest point lies in a face, on an edge or at a corner.
double distance_to_surface(const SynthBody& body, const Vec3& p) {
  double inside = -std::numeric_limits<double>::infinity();
  for (const auto& f : body.faces) inside = std::max(inside, f.normal.dot(p) - f.offset);
  if (inside <= 0) return inside;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& f : body.faces) {
    const double height = f.normal.dot(p) - f.offset;
    const Vec3 foot = p - height * f.normal;
    const bool on_face = height > 0 && std::all_of(body.faces.begin(), body.faces.end(),
                                                   [&](const auto& g) { return g.normal.dot(foot) - g.offset <= kCoplanar; });
    if (on_face) nearest = std::min(nearest, height);
  }
  for (const auto& e : body.edges) {
    const Vec3 &from = body.vertices[e.from], along = body.vertices[e.to] - from;
    const double s = std::clamp(along.dot(p - from) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - from - s * along).norm());
  }
  return nearest;
}

}  // namespace

SynthBody synth_body(const Body& body) {
  SynthBody b;
  if (body.shape == Shape::sphere) {
    b.radius = b.reach = body.radius;
    b.inertia = 0.4 * body.radius * body.radius * Mat3::Identity();
    return b;
  }
  if (body.shape == Shape::box) {
    const double x = body.box.x() * body.box.x(), y = body.box.y() * body.box.y(), z = body.box.z() * body.box.z();
    b.inertia = Vec3(y + z, x + z, x + y).asDiagonal().toDenseMatrix() / 12;
    find_surface(box_mesh(body.box), b);
  } else {
    weigh(body.mesh, b);
    find_surface(body.mesh, b);
  }
  for (const Vec3& v : b.vertices) b.reach = std::max(b.reach, v.norm());
  return b;
}

TriangleMesh synth_mesh(Random& random) {
  TriangleMesh mesh;
  const std::size_t kind = random.index(3);
  const int sides = kind == 0 ? 6 : kind == 1 ? 3 : 4;
  const double radius = random.uniform(0.07, 0.10), height = random.uniform(0.09, 0.2), top = kind == 2 ? random.uniform(0.5, 0.75) : 1.0;
  const double stretch = random.uniform(1.0, 1.5);
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * kPi * i / sides, r = level == 0 ? radius : top * radius;
      mesh.vertices.push_back({stretch * r * std::cos(angle), r * std::sin(angle), level * height});
    }
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
    if (i == 0 || next == 0) continue;
    mesh.triangles.push_back({0, next, i});
    mesh.triangles.push_back({n, n + i, n + next});
  }
  return mesh;
}

double separation(const SynthBody& a, const SynthPose& at, const SynthBody& b, const SynthPose& bt) {
  if (a.sphere() && b.sphere()) return (at.p - bt.p).norm() - a.radius - b.radius;
  if (a.sphere()) return distance_to_surface(b, bt.q.conjugate() * (at.p - bt.p)) - a.radius;
  if (b.sphere()) return distance_to_surface(a, at.q.conjugate() * (bt.p - at.p)) - b.radius;
  return polyhedra(a, at, b, bt);
}

double separation(const SynthBody& a, const SynthPose& at, const Plane& floor, Vec3* lowest) {
  Vec3 at_bottom = at.p - a.radius * floor.normal;
  for (const Vec3& v : a.vertices) {
    const Vec3 p = at.p + at.q * v;
    if (&v == &a.vertices.front() || floor.signed_distance(p) < floor.signed_distance(at_bottom)) at_bottom = p;
  }
  if (lowest != nullptr) *lowest = at_bottom;
  return floor.signed_distance(at_bottom);
}

}  // namespace unseen::collision
