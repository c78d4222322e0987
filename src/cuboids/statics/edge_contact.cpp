// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/edge_contact.h"

#include <algorithm>
#include <cmath>

#include "cuboids/statics/clip.h"

namespace unseen::cuboids {
namespace {

constexpr double kParallel = 1e-3;  // sine
constexpr double kShareOfEdge = 0.25;     // of an edge that is contact enough, however short the edge
constexpr double kFacing = 2.0;  // tolerances that faces which face each other may part by over their width
constexpr double kAngleRounding = 1e-9;

using Edge = std::array<int, 2>;

/// The faces on both sides of an edge.
struct Ridge {
  Vec3 normal[2];
  double width[2];  ///< m
};

std::optional<Ridge> ridge_at(const ConvexSolid& solid, const Edge& edge) {
  Ridge ridge;
  int found = 0;
  for (std::size_t f = 0; f < solid.faces.size() && found < 2; ++f) {
    const std::vector<int>& loop = solid.faces[f];
    if (std::find(loop.begin(), loop.end(), edge[0]) == loop.end()) continue;
    if (std::find(loop.begin(), loop.end(), edge[1]) == loop.end()) continue;
    std::vector<Vec3> corners;
    for (const int i : loop) corners.push_back(solid.vertices[i]);
    ridge.normal[found] = solid.planes[f].normal;
    ridge.width[found++] = width_of(corners, solid.planes[f].normal);
  }
  return found == 2 ? std::optional(ridge) : std::nullopt;
}

/// The part that two nearly parallel edges have in common, seen across them: its ends on each.
struct Common {
  Vec3 on_a[2], on_b[2];
  double apart = 0;  ///< m, at the farther end
};

std::optional<Common> common_part(const ConvexSolid& a, const Edge& ea, const ConvexSolid& b, const Edge& eb,
                                  double tolerance) {
  const Vec3 p = a.vertices[ea[0]], u = a.vertices[ea[1]] - p;
  Vec3 q = b.vertices[eb[0]], v = b.vertices[eb[1]] - q;
  if (u.cross(v).norm() >= kParallel * u.norm() * v.norm()) return std::nullopt;
  if (u.dot(v) < 0.0) {
    q += v;
    v = -v;
  }
  const double length = u.norm(), start = (q - p).dot(u) / length, other = v.dot(u) / length;
  const double low = std::max(0.0, start), high = std::min(length, start + other);
  if (high - low < std::min(tolerance, kShareOfEdge * std::min(length, other)) || high <= low) return std::nullopt;
  Common common;
  for (int i = 0; i < 2; ++i) {
    const double at = i == 0 ? low : high;
    common.on_a[i] = p + at / length * u;
    common.on_b[i] = q + (at - start) / other * v;
    common.apart = std::max(common.apart, (common.on_b[i] - common.on_a[i]).norm());
  }
  return common.apart <= tolerance ? std::optional(common) : std::nullopt;
}

bool face_each_other(const Ridge& a, const Ridge& b, double tolerance) {
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      const double part = a.normal[i].cross(b.normal[k]).norm() * std::min(a.width[i], b.width[k]);
      if (a.normal[i].dot(b.normal[k]) < 0.0 && part <= kFacing * tolerance) return true;
    }
  return false;
}

/// Whether a direction across an edge is a sum of two others with weights that are not negative.
bool is_between(const Vec3& x, const Vec3& one, const Vec3& two) {
  const double cosine = one.dot(two);
  return x.dot(one) - cosine * x.dot(two) >= -kAngleRounding && x.dot(two) - cosine * x.dot(one) >= -kAngleRounding;
}

/// Half-way between the outermost of the normals (from a to b) that both edges have.
std::optional<Vec3> middle_normal(const Ridge& a, const Ridge& b) {
  Vec3 sum = Vec3::Zero();
  int outermost = 0;
  for (const Vec3& n : a.normal)
    if (is_between(-n, b.normal[0], b.normal[1])) {
      sum += n;
      ++outermost;
    }
  for (const Vec3& n : b.normal)
    if (is_between(-n, a.normal[0], a.normal[1])) {
      sum -= n;
      ++outermost;
    }
  if (outermost != 2 || sum.norm() < kAngleRounding) return std::nullopt;
  return sum.normalized();
}

}  // namespace

std::optional<Interface> along_edges(const ConvexSolid& a, const ConvexSolid& b, double tolerance) {
  std::optional<Interface> best;
  double nearest = INFINITY;
  for (const Edge& ea : a.edges)
    for (const Edge& eb : b.edges) {
      const auto common = common_part(a, ea, b, eb, tolerance);
      if (!common || common->apart >= nearest) continue;
      const auto on_a = ridge_at(a, ea), on_b = ridge_at(b, eb);
      if (!on_a || !on_b || face_each_other(*on_a, *on_b, tolerance)) continue;
      const auto normal = middle_normal(*on_a, *on_b);
      if (!normal) continue;
      nearest = common->apart;
      best = Interface{*normal, INFINITY, {}, {}};
      for (int i = 0; i < 2; ++i) {
        best->gaps.push_back(normal->dot(common->on_b[i] - common->on_a[i]));
        best->gap = std::min(best->gap, best->gaps.back());
        best->points.push_back(0.5 * (common->on_a[i] + common->on_b[i]));
      }
    }
  return best;
}

}  // namespace unseen::cuboids
