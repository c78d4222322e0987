// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/interface.h"

#include <algorithm>
#include <cmath>

#include "cuboids/statics/clip.h"
#include "cuboids/statics/edge_contact.h"

namespace unseen::cuboids {
namespace {

constexpr double kBand = 2.0;          // tolerances: how much farther than the nearest point a contact may be
constexpr double kAskew = 0.34202014;  // sin 20°: more than that is no face on a face
constexpr double kNarrow = 0.05;       // of the face's width
constexpr double kShareOfFace = 0.25;        // of a face's width that is contact enough, however thin the face
constexpr std::size_t kMostPoints = 8;

/// A face, or a support, that another body may lie on: its outward plane and the planes around it.
struct Seat {
  Plane plane;
  std::vector<Plane> sides;
  double width = INFINITY;
};

Seat seat_of(const Plane& plane, const std::vector<Vec3>& outline, double widened) {
  Seat seat{plane, {}, outline.empty() ? INFINITY : width_of(outline, plane.normal)};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 edge = outline[(i + 1) % outline.size()] - outline[i];
    const Vec3 outward = edge.cross(plane.normal);
    if (outward.norm() == 0.0) continue;
    seat.sides.push_back({outward.normalized(), outward.normalized().dot(outline[i]) + widened});
  }
  return seat;
}

std::vector<Vec3> corners(const ConvexSolid& solid, std::size_t face) {
  std::vector<Vec3> polygon;
  for (const int i : solid.faces[face]) polygon.push_back(solid.vertices[i]);
  return polygon;
}

/// Drops corners that coincide, then those that matter least to the area.
void thin(std::vector<Vec3>& polygon, double least) {
  const auto corner_size = [&](std::size_t i) {
    const std::size_t n = polygon.size();
    const Vec3 &before = polygon[(i + n - 1) % n], &after = polygon[(i + 1) % n];
    return (polygon[i] - before).cross(after - before).norm();
  };
  for (std::size_t i = 0; i < polygon.size();)
    if (polygon.size() > 1 && (polygon[i] - polygon[(i + 1) % polygon.size()]).norm() < least) {
      polygon.erase(polygon.begin() + i);
    } else {
      ++i;
    }
  while (polygon.size() > kMostPoints) {
    std::size_t smallest = 0;
    for (std::size_t i = 1; i < polygon.size(); ++i)
      if (corner_size(i) < corner_size(smallest)) smallest = i;
    polygon.erase(polygon.begin() + smallest);
  }
}

/// The lowest edge of a polygon that lies askew, or its lowest corner if no edge is nearly level.
std::vector<Vec3> lowest_edge(const std::vector<Vec3>& polygon, const Plane& plane, double band) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    if (plane.signed_distance(polygon[i]) < plane.signed_distance(polygon[lowest])) lowest = i;
  const Vec3& low = polygon[lowest];
  Vec3 end = low;
  double least_slope = kAskew;
  for (const std::size_t i : {(lowest + 1) % polygon.size(), (lowest + polygon.size() - 1) % polygon.size()}) {
    const double rise = plane.signed_distance(polygon[i]) - plane.signed_distance(low);
    const double length = (polygon[i] - low).norm();
    if (length == 0.0 || rise / length >= least_slope) continue;
    if (rise > 0.0 && band / rise < kNarrow) continue;
    least_slope = rise / length;
    end = low + (rise > band ? band / rise : 1.0) * (polygon[i] - low);
  }
  if (end == low) return {low};
  return {low, end};
}

/// Where a body lies on a seat; the normal is the seat's.
std::optional<Interface> rest(const Seat& seat, const ConvexSolid& body, double tolerance) {
  std::size_t face = 0;
  for (std::size_t i = 1; i < body.planes.size(); ++i)
    if (body.planes[i].normal.dot(seat.plane.normal) < body.planes[face].normal.dot(seat.plane.normal) - 1e-12)
      face = i;
  const std::vector<Vec3> whole = corners(body, face);
  const double face_width = width_of(whole, body.planes[face].normal);
  const bool askew = body.planes[face].normal.cross(seat.plane.normal).norm() > kAskew;
  std::vector<Vec3> common = whole;
  for (const Plane& side : seat.sides) common = clip(common, side);
  if (common.size() < 3) return std::nullopt;
  const double enough = std::min(tolerance, kShareOfFace * std::min(seat.width, face_width));
  if (width_of(common, body.planes[face].normal) < enough) return std::nullopt;

  double low = INFINITY, high = -INFINITY;
  for (const Vec3& p : common) {
    low = std::min(low, seat.plane.signed_distance(p));
    high = std::max(high, seat.plane.signed_distance(p));
  }
  if (low > tolerance) return std::nullopt;
  const double band = kBand * tolerance;
  std::vector<Vec3> touching = common;
  if (high > low + band) {
    touching = clip(common, {seat.plane.normal, seat.plane.offset + low + band});
    if (askew || width_of(touching, body.planes[face].normal) < kNarrow * face_width)
      touching = lowest_edge(common, seat.plane, band);
  }
  thin(touching, 1e-6 * body.radius);
  Interface result{seat.plane.normal, low, {}, {}};
  for (const Vec3& p : touching) {
    result.gaps.push_back(seat.plane.signed_distance(p));
    result.points.push_back(p - 0.5 * result.gaps.back() * seat.plane.normal);
  }
  return result;
}

double lowest(const ConvexSolid& solid, const Vec3& direction) {
  double least = INFINITY;
  for (const Vec3& v : solid.vertices) least = std::min(least, direction.dot(v));
  return least;
}

struct BestFace {
  std::size_t face = 0;
  double gap = -INFINITY;
};

/// The face of a solid that separates it best from another.
BestFace best_face(const ConvexSolid& of, const ConvexSolid& from, double enough) {
  BestFace best;
  for (std::size_t i = 0; i < of.planes.size() && best.gap <= enough; ++i) {
    const double gap = lowest(from, of.planes[i].normal) - of.planes[i].offset;
    if (gap > best.gap) best = {i, gap};
  }
  return best;
}

struct BestEdges {
  Vec3 normal = Vec3::Zero();  ///< from a to b
  double gap = -INFINITY;
};

BestEdges best_edges(const ConvexSolid& a, const ConvexSolid& b) {
  BestEdges best;
  for (const Vec3& u : a.edge_directions)
    for (const Vec3& v : b.edge_directions) {
      Vec3 normal = u.cross(v);
      const double sine = normal.norm();
      if (sine < 1e-3) continue;  // parallel: the faces beside them tell, or along_edges
      normal *= (normal.dot(b.center - a.center) < 0.0 ? -1.0 : 1.0) / sine;
      const double gap = lowest(b, normal) + lowest(a, -normal);
      if (gap > best.gap) best = {normal, gap};
    }
  return best;
}

/// The point where two crossing edges meet, if the edges that are extreme along the normal do.
std::optional<Interface> crossing(const ConvexSolid& a, const ConvexSolid& b, const BestEdges& edges) {
  const double top = -lowest(a, -edges.normal), bottom = lowest(b, edges.normal);
  const double flat = 1e-6 * (a.radius + b.radius);
  const auto is_extreme = [&](const ConvexSolid& s, const std::array<int, 2>& edge, double height) {
    return std::abs(edges.normal.dot(s.vertices[edge[0]]) - height) < flat &&
           std::abs(edges.normal.dot(s.vertices[edge[1]]) - height) < flat;
  };
  for (const auto& ea : a.edges) {
    if (!is_extreme(a, ea, top)) continue;
    const Vec3 p = a.vertices[ea[0]], u = a.vertices[ea[1]] - p;
    for (const auto& eb : b.edges) {
      if (!is_extreme(b, eb, bottom)) continue;
      const Vec3 q = b.vertices[eb[0]], v = b.vertices[eb[1]] - q;
      const Vec3 across = u.cross(v);
      if (across.squaredNorm() < 1e-12 * u.squaredNorm() * v.squaredNorm()) continue;
      const double s = (q - p).cross(v).dot(across) / across.squaredNorm();
      const double t = (q - p).cross(u).dot(across) / across.squaredNorm();
      if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) continue;
      return Interface{edges.normal, edges.gap, {0.5 * (p + s * u + q + t * v)}, {edges.gap}};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Interface> interface_of(const ConvexSolid& a, const ConvexSolid& b, double tolerance) {
  if ((b.center - a.center).norm() > a.radius + b.radius + tolerance) return std::nullopt;
  const BestFace face_a = best_face(a, b, tolerance);
  if (face_a.gap > tolerance) return std::nullopt;
  const BestFace face_b = best_face(b, a, tolerance);
  if (face_b.gap > tolerance) return std::nullopt;
  const BestEdges edges = best_edges(a, b);
  if (edges.gap > tolerance) return std::nullopt;
  if (edges.gap > std::max(face_a.gap, face_b.gap) + tolerance)
    if (const auto crossed = crossing(a, b, edges)) return crossed;
  const bool on_a = face_a.gap >= face_b.gap - 1e-2 * tolerance;
  const ConvexSolid& under = on_a ? a : b;
  const std::size_t face = on_a ? face_a.face : face_b.face;
  auto result = rest(seat_of(under.planes[face], corners(under, face), 0.0), on_a ? b : a, tolerance);
  if (!result || result->points.size() <= 2)
    if (auto along = along_edges(a, b, tolerance)) return along;
  if (result && !on_a) result->normal = -result->normal;
  return result;
}

std::optional<Interface> interface_of(const Support& a, const ConvexSolid& b, double tolerance) {
  if (a.plane.signed_distance(b.center) > b.radius + tolerance) return std::nullopt;
  if (!a.outline.empty() && -lowest(b, -a.plane.normal) < a.plane.offset) return std::nullopt;  // below a desk
  return rest(seat_of(a.plane, a.outline, tolerance), b, tolerance);
}

}  // namespace unseen::cuboids
