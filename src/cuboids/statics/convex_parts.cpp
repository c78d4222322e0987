// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cuboids/statics/clip.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kMostParts = 256, kMostCells = 4096;
constexpr double kFlatPart = 1e-5;  // of the radius: what is thinner is nothing

using Polygon = std::vector<Vec3>;

/// A convex polyhedron by its faces.
struct Cell {
  std::vector<Polygon> faces;
  std::vector<Plane> planes;
};

Cell box_around(const TriangleMesh& mesh, double wider) {
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const ConvexSolid solid =
      solid_of(OrientedBox{0.5 * (low + high), Mat3::Identity(), 0.5 * (high - low) + Vec3::Constant(wider)});
  Cell cell{{}, solid.planes};
  for (const std::vector<int>& loop : solid.faces) {
    Polygon face;
    for (const int i : loop) face.push_back(solid.vertices[i]);
    cell.faces.push_back(std::move(face));
  }
  return cell;
}

/// Corners around their middle, counter-clockwise as seen along −normal.
void sort_around(Polygon& corners, const Vec3& normal) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : corners) middle += p / static_cast<double>(corners.size());
  const Vec3 u = any_orthogonal(normal), v = normal.cross(u);
  std::sort(corners.begin(), corners.end(), [&](const Vec3& p, const Vec3& q) {
    return std::atan2(v.dot(p - middle), u.dot(p - middle)) < std::atan2(v.dot(q - middle), u.dot(q - middle));
  });
}

Cell behind(const Cell& cell, const Plane& plane, double thin) {
  Cell part;
  Polygon cap;
  for (std::size_t i = 0; i < cell.faces.size(); ++i) {
    Polygon face = clip(cell.faces[i], plane);
    for (const Vec3& p : face)
      if (std::abs(plane.signed_distance(p)) < 1e-3 * thin) cap.push_back(p);
    if (face.size() < 3) continue;
    part.faces.push_back(std::move(face));
    part.planes.push_back(cell.planes[i]);
  }
  Polygon single;
  for (const Vec3& p : cap)
    if (std::none_of(single.begin(), single.end(), [&](const Vec3& q) { return (p - q).norm() < 1e-2 * thin; }))
      single.push_back(p);
  if (single.size() < 3) return part;
  sort_around(single, plane.normal);
  part.faces.push_back(std::move(single));
  part.planes.push_back(plane);
  return part;
}

/// A triangle's plane if the triangle runs through the inside of the cell, not just along a face.
bool cuts(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t, const Cell& cell, double thin, Plane& plane) {
  Polygon part = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  const Vec3 normal = (part[1] - part[0]).cross(part[2] - part[0]);
  if (normal.norm() < thin * thin) return false;
  plane = {normal.normalized(), normal.normalized().dot(part[0])};
  for (const Plane& side : cell.planes) {
    part = clip(part, {side.normal, side.offset - thin});
    if (part.size() < 3) return false;
  }
  return width_of(part, plane.normal) > thin;
}

/// How often the surface winds around a point (sum of solid angles; Van Oosterom & Strackee, 1983).
double winding(const TriangleMesh& mesh, const Vec3& at) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - at, b = mesh.vertices[t[1]] - at, c = mesh.vertices[t[2]] - at;
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
  }
  return sum / (4.0 * kPi);
}

TriangleMesh mesh_of(const Cell& cell) {
  TriangleMesh mesh;
  for (const Polygon& face : cell.faces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), face.begin(), face.end());
    for (std::uint32_t i = 2; i < face.size(); ++i) mesh.triangles.push_back({first, first + i - 1, first + i});
  }
  return mesh;
}

void require_closed(const TriangleMesh& mesh) {
  Vec3 open = Vec3::Zero();
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 doubled =
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    open += doubled;
    area += doubled.norm();
  }
  if (!(open.norm() <= 1e-3 * area)) throw std::invalid_argument("it is not closed");
}

}  // namespace

MassCenter mass_center(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.vertices.empty() ? Vec3(Vec3::Zero()) : mesh.vertices.front();
  MassCenter result;
  Vec3 moment = Vec3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin;
    const double part = a.dot(b.cross(c)) / 6.0;
    result.volume += part;
    moment += part * (a + b + c) / 4.0;
  }
  result.center = result.volume != 0.0 ? Vec3(origin + moment / result.volume) : origin;
  return result;
}

std::vector<ConvexSolid> convex_parts(const TriangleMesh& mesh) {
  try {
    return {solid_of(mesh)};
  } catch (const std::invalid_argument& e) {
    if (std::string(e.what()) != "it is not convex") throw;
  }
  require_closed(mesh);
  const double radius = std::cbrt(std::abs(mass_center(mesh).volume));
  const double thin = kFlatPart * radius;
  std::vector<Cell> waiting = {box_around(mesh, 4.0 * thin)};
  std::vector<ConvexSolid> parts;
  for (std::size_t seen = 0; !waiting.empty(); ++seen) {
    if (seen == kMostCells || parts.size() == kMostParts)
      throw std::invalid_argument("it is not convex, and too dented to be cut into convex parts");
    const Cell cell = std::move(waiting.back());
    waiting.pop_back();
    Plane plane;
    if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                    [&](const auto& t) { return cuts(mesh, t, cell, thin, plane); })) {
      waiting.push_back(behind(cell, plane, thin));
      waiting.push_back(behind(cell, {-plane.normal, -plane.offset}, thin));
      continue;
    }
    Vec3 middle = Vec3::Zero();
    const TriangleMesh filled = mesh_of(cell);
    for (const Vec3& v : filled.vertices) middle += v / static_cast<double>(filled.vertices.size());
    if (std::abs(winding(mesh, middle)) < 0.5) continue;
    try {
      parts.push_back(solid_of(filled));
    } catch (const std::invalid_argument&) {
      continue;  // a sliver
    }
  }
  // The faces of an open pipe cancel as well, but hold nothing.
  if (parts.empty()) throw std::invalid_argument("it is not closed");
  return parts;
}

}  // namespace unseen::cuboids
