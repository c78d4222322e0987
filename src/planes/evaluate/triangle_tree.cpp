// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/evaluate/triangle_tree.h"

#include <algorithm>
#include <array>
#include <limits>

namespace unseen::planes {

namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kMaxDepth = 64;  // halving at the median: 2³² triangles need 32

}  // namespace

// Ericson, Real-Time Collision Detection, Section 5.1.5.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1.0 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
    const Vec3 cross = (b - a).cross(c - a);
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!(cross.norm() > 1e-9 * longest)) continue;  // no area, or not finite
    triangles_.push_back({a, b, c, cross.normalized(), i});
  }
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    box.extend(t.a).extend(t.b).extend(t.c);
    centers.extend(t.a + t.b + t.c);
  }
  nodes_[at].box = box;
  nodes_[at].begin = begin;
  nodes_[at].end = end;
  if (end - begin <= kLeafSize) return at;
  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [axis](const Triangle& s, const Triangle& t) {
                     const double x = s.a[axis] + s.b[axis] + s.c[axis],
                                  y = t.a[axis] + t.b[axis] + t.c[axis];
                     return x < y || (x == y && s.index < t.index);
                   });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[at].right = right;
  return at;
}

TriangleTree::Hit TriangleTree::nearest(const Vec3& p) const {
  Hit best;
  double best_squared = std::numeric_limits<double>::infinity();
  std::array<std::pair<std::uint32_t, double>, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
  while (size > 0) {
    const auto [at, bound] = stack[--size];
    if (bound > best_squared) continue;
    const Node& node = nodes_[at];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const Triangle& t = triangles_[i];
        const Vec3 q = nearest_on_triangle(p, t.a, t.b, t.c);
        const double squared = (p - q).squaredNorm();
        if (squared > best_squared || (squared == best_squared && t.index >= best.triangle)) continue;
        best_squared = squared;
        best = {q, t.normal, 0, t.index};
      }
      continue;
    }
    const double left = nodes_[at + 1].box.squaredExteriorDistance(p);
    const double right = nodes_[node.right].box.squaredExteriorDistance(p);
    if (left <= right) {
      stack[size++] = {node.right, right};
      stack[size++] = {at + 1, left};
    } else {
      stack[size++] = {at + 1, left};
      stack[size++] = {node.right, right};
    }
  }
  best.distance = std::sqrt(best_squared);
  return best;
}

bool TriangleTree::normals_differ(const Vec3& p, double radius, double angle) const {
  if (empty()) return false;
  std::vector<Vec3> distinct;
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (node.box.squaredExteriorDistance(p) > radius * radius) continue;
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Triangle& t = triangles_[i];
      if ((p - nearest_on_triangle(p, t.a, t.b, t.c)).norm() > radius) continue;
      bool known = false;
      for (const Vec3& normal : distinct) {
        const double off = line_angle(normal, t.normal);
        if (off > angle) return true;
        known = known || off == 0.0;
      }
      if (!known) distinct.push_back(t.normal);
    }
  }
  return false;
}

}  // namespace unseen::planes
