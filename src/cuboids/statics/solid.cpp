// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cuboids/statics/interface.h"

namespace unseen::cuboids {
namespace {

constexpr double kFlat = 1e-5;      // of the radius: vertices so near a plane are on it
constexpr double kParallelSine = 1e-6;
constexpr double kLeast = 1e-30;    // radius: of smaller solids the squares of areas and weights vanish

Vec3 newell(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {  // doubled area
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (vertices[loop[i]] - vertices[loop[0]]).cross(vertices[loop[(i + 1) % loop.size()]] - vertices[loop[0]]);
  return sum;
}

void add_edges(ConvexSolid& solid) {
  for (const std::vector<int>& loop : solid.faces)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int from = loop[i], to = loop[(i + 1) % loop.size()];
      if (from > to) continue;  // the neighbouring face has it the other way round
      solid.edges.push_back({from, to});
      const Vec3 direction = (solid.vertices[to] - solid.vertices[from]).normalized();
      const auto same = [&](const Vec3& d) { return d.cross(direction).norm() < kParallelSine; };
      if (std::none_of(solid.edge_directions.begin(), solid.edge_directions.end(), same))
        solid.edge_directions.push_back(direction);
    }
}

void add_sphere(ConvexSolid& solid) {
  Vec3 low = solid.vertices.front(), high = low;
  for (const Vec3& v : solid.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  solid.center = 0.5 * (low + high);
  for (const Vec3& v : solid.vertices) solid.radius = std::max(solid.radius, (v - solid.center).norm());
}

/// The vertices on a plane as a convex loop, counter-clockwise from its normal's side; without those on its edges.
std::vector<int> loop_on(const std::vector<Vec3>& vertices, const Plane& plane, double flat) {
  std::vector<int> on;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (std::abs(plane.signed_distance(vertices[i])) < flat) on.push_back(static_cast<int>(i));
  const Vec3 u = any_orthogonal(plane.normal), v = plane.normal.cross(u);
  std::sort(on.begin(), on.end(), [&](int i, int k) {
    const double iu = u.dot(vertices[i]), ku = u.dot(vertices[k]);
    return iu != ku ? iu < ku : v.dot(vertices[i]) < v.dot(vertices[k]);
  });
  // Andrew's monotone chain; what turns by less than `flat` off its edge is no corner.
  const auto grow = [&](auto first, auto last) {
    std::vector<int> chain;
    for (auto it = first; it != last; ++it) {
      while (chain.size() > 1) {
        const Vec3 a = vertices[chain.back()] - vertices[chain[chain.size() - 2]];
        const Vec3 b = vertices[*it] - vertices[chain[chain.size() - 2]];
        if (plane.normal.dot(a.cross(b)) > flat * b.norm()) break;
        chain.pop_back();
      }
      chain.push_back(*it);
    }
    chain.pop_back();
    return chain;
  };
  if (on.size() < 3) return {};
  std::vector<int> loop = grow(on.begin(), on.end());
  const std::vector<int> back = grow(on.rbegin(), on.rend());
  loop.insert(loop.end(), back.begin(), back.end());
  return loop;
}

/// Vertices that several triangles of their own repeat become one.
TriangleMesh welded(const TriangleMesh& mesh, double flat) {
  TriangleMesh result;
  std::vector<std::uint32_t> place;
  for (const Vec3& v : mesh.vertices) {
    const auto same = [&](const Vec3& w) { return (v - w).norm() < flat; };
    const auto at = std::find_if(result.vertices.begin(), result.vertices.end(), same);
    place.push_back(static_cast<std::uint32_t>(at - result.vertices.begin()));
    if (at == result.vertices.end()) result.vertices.push_back(v);
  }
  for (const auto& t : mesh.triangles) result.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return result;
}

}  // namespace

ConvexSolid solid_of(const OrientedBox& box) {
  ConvexSolid solid;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    solid.vertices.push_back(box.center + box.axes * box.half_size.cwiseProduct(corner));
  }
  solid.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 normal = side * box.axes.col(axis);
      solid.planes.push_back({normal, normal.dot(box.center) + box.half_size[axis]});
    }
  solid.edges = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  solid.edge_directions = {box.axes.col(0), box.axes.col(1), box.axes.col(2)};
  solid.center = box.center;
  solid.radius = box.half_size.norm();
  return solid;
}

ConvexSolid solid_of(const TriangleMesh& mesh) {
  ConvexSolid solid;
  if (mesh.vertices.size() < 4) throw std::invalid_argument("a solid needs four vertices");
  solid.vertices = mesh.vertices;
  add_sphere(solid);
  const double flat = kFlat * solid.radius;
  const TriangleMesh whole = welded(mesh, flat);
  solid.vertices = whole.vertices;
  double volume = 0.0, area = 0.0, least_area = 0.0;
  for (const auto& t : whole.triangles) {
    const Vec3 a = whole.vertices[t[0]] - solid.center, b = whole.vertices[t[1]] - solid.center,
               c = whole.vertices[t[2]] - solid.center;
    volume += a.dot(b.cross(c)) / 6.0;
    area += (b - a).cross(c - a).norm() / 2.0;
  }
  if (!(std::abs(volume) > flat * solid.radius * solid.radius) || solid.radius < kLeast)
    throw std::invalid_argument("it has no volume");
  for (const auto& t : whole.triangles) {
    const Vec3 &a = whole.vertices[t[0]], &b = whole.vertices[t[1]], &c = whole.vertices[t[2]];
    Vec3 normal = (b - a).cross(c - a);
    if (normal.norm() < flat * std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()})) continue;  // no area
    normal *= (volume > 0.0 ? 1.0 : -1.0) / normal.norm();
    const Plane plane{normal, normal.dot(a + b + c) / 3.0};
    const auto same = [&](const Plane& p) {
      return p.normal.dot(normal) > 0.0 && std::abs(p.signed_distance(a)) < flat &&
             std::abs(p.signed_distance(b)) < flat && std::abs(p.signed_distance(c)) < flat;
    };
    if (std::any_of(solid.planes.begin(), solid.planes.end(), same)) continue;
    for (const Vec3& v : whole.vertices)
      if (plane.signed_distance(v) > flat) throw std::invalid_argument("it is not convex");
    std::vector<int> loop = loop_on(whole.vertices, plane, flat);
    if (loop.size() < 3) continue;
    const Vec3 doubled = newell(whole.vertices, loop);
    least_area += doubled.norm() / 2.0;
    solid.planes.push_back({doubled.normalized(), doubled.normalized().dot(whole.vertices[loop[0]])});
    solid.faces.push_back(std::move(loop));
  }
  // Of a convex solid the faces are all its triangles, and their areas as vectors cancel.
  Vec3 open = Vec3::Zero();
  for (const std::vector<int>& loop : solid.faces) open += newell(solid.vertices, loop) / 2.0;
  if (open.norm() > 1e-3 * area || std::abs(least_area - area) > 1e-3 * area)
    throw std::invalid_argument("it is not closed");
  add_edges(solid);
  return solid;
}

}  // namespace unseen::cuboids
