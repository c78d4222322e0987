// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/mass_properties.h"

#include <algorithm>
#include <map>
#include <string>

#include "core/linear.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

/// Throws unless every edge belongs to two triangles, once in each direction. Corners at the same place are one.
void check_closed(const TriangleMesh& mesh, const std::string& source, const std::string& field) {
  std::map<std::array<double, 3>, int> place;
  std::map<std::pair<int, int>, int> edges;
  const auto corner = [&](std::uint32_t v) {
    const Vec3& p = mesh.vertices[v];
    return place.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(place.size())).first->second;
  };
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{corner(t[i]), corner(t[(i + 1) % 3])}];
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto other = edges.find({edge.second, edge.first});
    if (other == edges.end() || other->second != count) ++open;
  }
  if (open > 0 || edges.empty())
    throw InputError(source, field, edges.empty() ? "no triangles" : std::to_string(open) + " open or doubled edges", "a closed mesh");
}

MassProperties of_mesh(const TriangleMesh& mesh, const std::string& source, const std::string& field) {
  check_closed(mesh, source, field);
  Vec3 origin = Vec3::Zero();
  for (const Vec3& v : mesh.vertices) origin += v / static_cast<double>(mesh.vertices.size());
  // Tetrahedra from the origin: ∫ x xᵀ over one is V/20 (Σ vᵢ vᵢᵀ + s sᵀ), with s the sum of its corners.
  double volume = 0.0, area = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin, s = a + b + c;
    const double v = a.dot(b.cross(c)) / 6.0;
    volume += v;
    area += 0.5 * (b - a).cross(c - a).norm();
    first += v / 4.0 * s;
    second += v / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  const double size = std::sqrt(std::max(area, 0.0));
  if (!(std::abs(volume) > 1e-9 * size * size * size)) throw InputError(source, field, "no volume", "a closed mesh");
  MassProperties m;
  const Vec3 center = first / volume;
  m.center = origin + center;
  m.volume = std::abs(volume);
  const Mat3 covariance = second / volume - center * center.transpose();
  const Mat3 inertia = covariance.trace() * Mat3::Identity() - covariance;
  const SymmetricEigen<3> principal = symmetric_eigen(inertia);
  m.inertia = principal.values;
  m.axes = principal.vectors;
  if (m.axes.determinant() < 0.0) m.axes.col(2) *= -1.0;
  for (const Vec3& v : mesh.vertices) m.reach = std::max(m.reach, (v - m.center).norm());
  m.extent = std::sqrt(area / kPi);  // exact for convex bodies (Cauchy): mean projected area = area / 4
  return m;
}

}  // namespace

MassProperties mass_properties(const Body& body, const std::string& source) {
  MassProperties m;
  switch (body.shape) {
    case Shape::mesh: return of_mesh(body.mesh, source, body.name + ".mesh");
    case Shape::box: {
      const Vec3 squares = body.box.cwiseAbs2();
      m.inertia = (squares.sum() * Vec3::Ones() - squares) / 12.0;
      m.volume = body.box.prod();
      const double area = 2.0 * (body.box.x() * body.box.y() + body.box.y() * body.box.z() + body.box.z() * body.box.x());
      m.extent = std::sqrt(area / kPi);
      m.reach = 0.5 * body.box.norm();
      return m;
    }
    case Shape::sphere:
    case Shape::size: {
      const double radius = body.shape == Shape::sphere ? body.radius : 0.5 * body.size;
      m.inertia = 0.4 * radius * radius * Vec3::Ones();
      m.volume = 4.0 / 3.0 * kPi * radius * radius * radius;
      m.extent = 2.0 * radius;
      m.reach = radius;
      return m;
    }
    case Shape::fixed: return m;
  }
  return m;
}

}  // namespace unseen::collision
