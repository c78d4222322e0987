// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace unseen::report {
namespace {

using Index = std::uint32_t;

constexpr double kSliver = 1e-7;  // height over length of a triangle that is a line in single precision: it has no normal, and is left out

/// Positions by vertex, shifted to the outline's first point; a chain lists vertices with the inside on its
/// left.
using Points = std::vector<Vec2>;
using Chain = std::vector<Index>;

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// True if the direction from b to `target` leaves into the inside at corner a → b → c.
bool leaves_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& target) {
  const double before = turn(a, b, target), after = turn(b, c, target);
  return turn(a, b, c) > 0 ? before > 0 && after > 0 : before > 0 || after > 0;
}

/// True if the closed segments meet anywhere but at an end that both share.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const bool p_is_end = p == a || p == b, q_is_end = q == a || q == b;
  if (p_is_end && q_is_end) return true;
  const double p_side = turn(a, b, p), q_side = turn(a, b, q);
  if (p_is_end || q_is_end) {
    const Vec2 other = p_is_end ? q : p, shared = p_is_end ? p : q, far = shared == a ? b : a;
    return turn(a, b, other) == 0 && (other - shared).dot(far - shared) > 0;  // runs along the segment
  }
  const double a_side = turn(p, q, a), b_side = turn(p, q, b);
  const auto apart = [](double s, double t) { return (s > 0 && t > 0) || (s < 0 && t < 0); };
  if (apart(p_side, q_side) || apart(a_side, b_side)) return false;
  if (p_side != 0 || q_side != 0) return true;
  const Vec2 along = b - a;  // all on one line: do the intervals overlap?
  const double s = (p - a).dot(along), t = (q - a).dot(along);
  return std::max(s, t) >= 0 && std::min(s, t) <= along.squaredNorm();
}

bool crosses(const Points& points, const Chain& chain, const Vec2& a, const Vec2& b) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Vec2 &p = points[chain[i]], &q = points[chain[(i + 1) % chain.size()]];
    if (p != q && segments_meet(a, b, p, q)) return true;
  }
  return false;
}

/// Position in `outline` of the nearest vertex that sees hole[at], with nothing between.
std::optional<std::size_t> nearest_visible(const Points& points, const Chain& outline,
                                           const std::vector<Chain>& holes, std::size_t hole,
                                           std::size_t at) {
  const Chain& own = holes[hole];
  const std::size_t m = own.size();
  const Vec2 &from = points[own[at]], &before = points[own[(at + m - 1) % m]],
             &after = points[own[(at + 1) % m]];
  std::vector<std::size_t> order(outline.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (points[outline[a]] - from).squaredNorm() < (points[outline[b]] - from).squaredNorm();
  });
  const std::size_t n = outline.size();
  for (const std::size_t i : order) {
    const Vec2& to = points[outline[i]];
    if (to == from) return i;
    if (!leaves_inside(points[outline[(i + n - 1) % n]], to, points[outline[(i + 1) % n]], from)) continue;
    if (!leaves_inside(before, from, after, to) || crosses(points, outline, from, to)) continue;
    bool blocked = false;
    for (std::size_t k = hole; k < holes.size() && !blocked; ++k)
      blocked = crosses(points, holes[k], from, to);
    if (!blocked) return i;
  }
  return std::nullopt;
}

/// Joins the holes to the outline, rightmost first: its rightmost vertex always sees the outline or a hole
/// that is joined already. A hole that sees nothing lies outside and is left out.
Chain join_holes(const Points& points, Chain outline, std::vector<Chain> holes) {
  const auto left_of = [&](Index a, Index b) { return points[a].x() < points[b].x(); };
  const auto right_end = [&](const Chain& c) {
    return points[*std::max_element(c.begin(), c.end(), left_of)].x();
  };
  std::stable_sort(holes.begin(), holes.end(),
                   [&](const Chain& a, const Chain& b) { return right_end(a) > right_end(b); });
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const Chain& hole = holes[h];
    const auto at =
        static_cast<std::size_t>(std::max_element(hole.begin(), hole.end(), left_of) - hole.begin());
    const auto to = nearest_visible(points, outline, holes, h, at);
    if (!to) continue;
    Chain joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(*to) + 1);
    for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(at + i) % hole.size()]);
    joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(*to), outline.end());
    outline = std::move(joined);
  }
  return outline;
}

/// Points in square cells, so that only those near a triangle need be looked at.
class Grid {
 public:
  Grid(const Points& points, const Chain& chain) {
    for (const Index i : chain) box_.extend(points[i]);
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(chain.size()))), 1, 1024);
    cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  }
  void add(std::size_t item, const Vec2& p) { cells_[cell(column(p, 0), column(p, 1))].push_back(item); }
  /// True if `test` says so for an item in a cell that the triangle's bounding box meets.
  template <class Test>
  bool any(const Vec2& a, const Vec2& b, const Vec2& c, Test test) const {
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int y = column(low, 1); y <= column(high, 1); ++y)
      for (int x = column(low, 0); x <= column(high, 0); ++x)
        for (const std::size_t item : cells_[cell(x, y)])
          if (test(item)) return true;
    return false;
  }

 private:
  int column(const Vec2& p, int axis) const {
    const double size = box_.sizes()[axis];
    return size > 0 ? std::min(static_cast<int>((p[axis] - box_.min()[axis]) / size * side_), side_ - 1) : 0;
  }
  std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }

  Eigen::AlignedBox2d box_;
  int side_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

/// The chain as a ring of links, from which ears are cut.
struct Ears {
  const Points& points;
  const Chain& chain;
  std::vector<std::size_t> prev, next;
  std::vector<bool> reflex;  ///< positions that may lie in an ear: neither convex nor cut off
  Grid grid;                 ///< holds what was reflex at the start

  Ears(const Points& points_, const Chain& chain_) : points(points_), chain(chain_), grid(points_, chain_) {
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

std::vector<Triangle> cut_ears(const Points& points, const Chain& chain) {
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
  Points points;
  std::vector<Chain> chains;
  for (const Ring& ring : rings) {
    Chain chain;
    for (const Vec2& p : ring) {
      const Vec2 shifted = p - rings[0][0];
      if (chain.empty() || points[chain.back()] != shifted)
        chain.push_back(static_cast<Index>(points.size()));
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
