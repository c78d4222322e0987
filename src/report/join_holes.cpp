// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <optional>

#include "report/flat_chain.h"
#include "report/flat_grid.h"

namespace unseen::report {
namespace {

using Index = std::uint32_t;

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

/// The outline with the holes that are joined so far, as a ring of links, and all that a bridge may not cross.
class Joined {
 public:
  Joined(const FlatPoints& points, const Chain& outline, const std::vector<Chain>& holes)
      : points_(points), links_at_(points), edges_at_(points) {
    for (std::size_t i = 0; i < outline.size(); ++i) append(outline[i]);
    for (std::size_t i = 0; i < outline.size(); ++i) connect(i, (i + 1) % outline.size());
    add_edges(outline);
    for (const Chain& hole : holes) add_edges(hole);
  }

  /// Joins a hole at one of its vertices to the nearest link that sees it, if any does.
  void join(const Chain& hole, std::size_t at) {
    const std::size_t m = hole.size();
    const auto vertex = [&](std::size_t i) { return hole[(at + i) % m]; };
    const std::optional<std::size_t> to = nearest_visible(point(vertex(m - 1)), point(vertex(0)), point(vertex(1)));
    if (!to) return;
    const std::size_t after = links_[*to].next;
    std::size_t last = *to;
    const auto link = [&](Index v) {
      const std::size_t added = append(v);
      connect(last, added);
      last = added;
    };
    for (std::size_t i = 0; i <= m; ++i) link(vertex(i));
    link(links_[*to].vertex);
    connect(last, after);
    add_edge(vertex(0), links_[*to].vertex);
  }

  Chain chain() const {
    Chain all;
    std::size_t at = 0;
    do {
      all.push_back(links_[at].vertex);
      at = links_[at].next;
    } while (at != 0);
    return all;
  }

 private:
  struct Link {
    Index vertex;
    std::size_t prev = 0, next = 0;
  };

  const Vec2& point(Index vertex) const { return points_[vertex]; }
  std::size_t append(Index vertex) {
    links_.push_back({vertex});
    links_at_.add(links_.size() - 1, point(vertex));
    return links_.size() - 1;
  }
  void connect(std::size_t a, std::size_t b) {
    links_[a].next = b;
    links_[b].prev = a;
  }
  void add_edge(Index a, Index b) {
    if (point(a) == point(b)) return;
    edges_.emplace_back(a, b);
    edges_at_.add(edges_.size() - 1, point(a), point(b));
  }
  void add_edges(const Chain& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) add_edge(ring[i], ring[(i + 1) % ring.size()]);
  }

  /// The nearest link that sees corner `before` → `from` → `after` of a hole, with nothing between.
  std::optional<std::size_t> nearest_visible(const Vec2& before, const Vec2& from, const Vec2& after) const {
    std::optional<std::size_t> found;
    links_at_.nearest_first(from, [&](std::size_t i) { return point(links_[i].vertex); }, [&](std::size_t i) {
      const Link& link = links_[i];
      const Vec2& to = point(link.vertex);
      const bool seen = to == from || (leaves_inside(point(links_[link.prev].vertex), to, point(links_[link.next].vertex), from) &&
                                       leaves_inside(before, from, after, to) && !crosses(from, to));
      if (seen) found = i;
      return seen;
    });
    return found;
  }
  bool crosses(const Vec2& a, const Vec2& b) const {
    return edges_at_.any(a, b, [&](std::size_t e) { return segments_meet(a, b, point(edges_[e].first), point(edges_[e].second)); });
  }

  const FlatPoints& points_;
  std::vector<Link> links_;
  std::vector<std::pair<Index, Index>> edges_;  ///< of the outline, of all holes, and bridges
  FlatGrid links_at_, edges_at_;
};

}  // namespace

/// Rightmost first: the rightmost vertex of a hole always sees the outline or a hole that is joined already.
Chain join_holes(const FlatPoints& points, const Chain& outline, std::vector<Chain> holes) {
  const auto left_of = [&](Index a, Index b) { return points[a].x() < points[b].x(); };
  const auto rightmost = [&](const Chain& c) { return static_cast<std::size_t>(std::max_element(c.begin(), c.end(), left_of) - c.begin()); };
  std::stable_sort(holes.begin(), holes.end(), [&](const Chain& a, const Chain& b) {
    return points[a[rightmost(a)]].x() > points[b[rightmost(b)]].x();
  });
  Joined joined(points, outline, holes);
  for (const Chain& hole : holes) joined.join(hole, rightmost(hole));
  return joined.chain();
}

}  // namespace unseen::report
