// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/flat_chain.h"
#include "report/flat_grid.h"

namespace unseen::report {
namespace {

constexpr double kSliver = 1e-7;  // height over length of a triangle that is a line in single precision: it has no normal, and is left out

/// The chain as a ring of links, from which ears are cut.
struct Ears {
  const FlatPoints& points;
  const Chain& chain;
  std::vector<std::size_t> prev, next;
  std::vector<bool> reflex;  ///< positions that may lie in an ear: neither convex nor cut off
  FlatGrid grid;             ///< holds what was reflex at the start

  Ears(const FlatPoints& points_, const Chain& chain_) : points(points_), chain(chain_), grid(points_) {
    const std::size_t n = chain.size();
    for (std::size_t i = 0; i < n; ++i) {
      prev.push_back((i + n - 1) % n);
      next.push_back((i + 1) % n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      reflex.push_back(!(corner(i) > 0));
      if (reflex[i]) grid.add(i, at(i));
    }
  }

  const Vec2& at(std::size_t i) const { return points[chain[i]]; }
  double corner(std::size_t i) const { return turn(at(prev[i]), at(i), at(next[i])); }
  bool is_sliver(std::size_t i) const {
    const Vec2 &a = at(prev[i]), &b = at(i), &c = at(next[i]);
    return corner(i) < kSliver * std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  }

  bool is_ear(std::size_t i) const {
    const std::size_t a = prev[i], c = next[i];
    const Vec2 &pa = at(a), &pb = at(i), &pc = at(c);
    if (!(turn(pa, pb, pc) > 0)) return false;
    if (!leaves_inside(at(prev[a]), pa, pb, pc) || !leaves_inside(pb, pc, at(next[c]), pa)) return false;
    return !grid.any(pa, pb, pc, [&](std::size_t r) {
      const Vec2& p = at(r);
      if (!reflex[r] || p == pa || p == pb || p == pc) return false;
      return turn(pa, pb, p) >= 0 && turn(pb, pc, p) >= 0 && turn(pc, pa, p) >= 0;
    });
  }

  void cut(std::size_t i) {
    next[prev[i]] = next[i];
    prev[next[i]] = prev[i];
    reflex[i] = false;
    for (const std::size_t k : {prev[i], next[i]})
      if (corner(k) > 0) reflex[k] = false;
  }
};

std::vector<Triangle> cut_ears(const FlatPoints& points, const Chain& chain) {
  std::vector<Triangle> triangles;
  Ears ears(points, chain);
  std::size_t at = 0, left = chain.size(), since_cut = 0, flattest = 0;
  double flattest_corner = std::numeric_limits<double>::infinity();
  while (left >= 3) {
    const bool stuck = since_cut > left;  // only collinear or crossing rests: give up the flattest corner
    if (stuck) at = flattest;
    if (stuck || left == 3 || ears.is_ear(at)) {
      if (!ears.is_sliver(at)) triangles.push_back({chain[ears.prev[at]], chain[at], chain[ears.next[at]]});
      ears.cut(at);
      --left;
      since_cut = 0;
      flattest_corner = std::numeric_limits<double>::infinity();
      at = ears.next[ears.next[at]];  // the next but one: fewer thin triangles
      continue;
    }
    if (std::abs(ears.corner(at)) < flattest_corner)
      flattest_corner = std::abs(ears.corner(at)), flattest = at;
    at = ears.next[at];
    ++since_cut;
  }
  return triangles;
}

}  // namespace

double doubled_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += turn(ring[0], ring[i], ring[i + 1]);
  return sum;
}

std::vector<Triangle> triangulate(const std::vector<Ring>& rings) {
  if (rings.empty() || rings[0].size() < 3) return {};
  FlatPoints points;
  std::vector<Chain> chains;
  for (const Ring& ring : rings) {
    Chain chain;
    for (const Vec2& p : ring) {
      const Vec2 shifted = p - rings[0][0];
      if (chain.empty() || points[chain.back()] != shifted)
        chain.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(shifted);
    }
    const bool is_hole = &ring != &rings[0];
    if ((doubled_area(ring) < 0) != is_hole) std::reverse(chain.begin(), chain.end());
    if (chain.size() >= 3)
      chains.push_back(std::move(chain));
    else if (!is_hole)
      return {};
  }
  const Chain outline = std::move(chains.front());
  chains.erase(chains.begin());
  return cut_ears(points, join_holes(points, outline, std::move(chains)));
}

std::vector<Triangle> triangulate(const planes::Polygon& polygon, const Vec3& normal) {
  const Vec3 u = any_orthogonal(normal);
  return triangulate(flat_rings(polygon, u, normal.cross(u)));
}

std::vector<Ring> flat_rings(const planes::Polygon& polygon, const Vec3& u, const Vec3& v) {
  std::vector<Ring> rings;
  if (polygon.empty() || polygon[0].empty()) return rings;
  const Vec3 origin = polygon[0][0];
  for (const auto& ring : polygon) {
    Ring& flat = rings.emplace_back();
    for (const Vec3& p : ring) flat.emplace_back(u.dot(p - origin), v.dot(p - origin));
  }
  return rings;
}

}  // namespace unseen::report
