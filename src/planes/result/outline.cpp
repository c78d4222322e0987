// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/outline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "planes/result/raster.h"

namespace unseen::planes {
namespace {

constexpr int kLargestRaster = 1500;  // cells along an edge; larger planes get larger cells
constexpr int kWidest = 16;           // cells, that gaps are closed by at most
constexpr int kFewNear = 14;          // cells with points within reach of one that is sparse: where there are more, chance leaves few gaps that half the reach does not close

/// What lies between full cells where these are sparse, with few others within some reach for as much of that as the surface fills: gaps of up to twice that reach.
Raster filled_where_sparse(const Raster& points) {
  const Counts counts(points);
  const auto x = [&](std::size_t c) { return static_cast<int>(c % points.width); };
  const auto y = [&](std::size_t c) { return static_cast<int>(c / points.width); };
  std::vector<std::size_t> few;
  for (std::size_t c = 0; c < points.cells.size(); ++c)
    if (points.cells[c]) few.push_back(c);
  Raster full = points;
  for (int reach = 4; reach <= kWidest; reach *= 2) {
    std::erase_if(few, [&](std::size_t c) { return counts.around(x(c), y(c), reach) > kFewNear; });
    if (few.empty()) break;
    const Raster region = closed(points, reach);
    const Counts filled(region);
    const double window = (2.0 * reach + 1) * (2.0 * reach + 1);
    Raster sparse = points;
    std::fill(sparse.cells.begin(), sparse.cells.end(), 0);
    bool any = false;
    for (const std::size_t c : few)
      if (window * counts.around(x(c), y(c), reach) <= kFewNear * static_cast<double>(filled.around(x(c), y(c), reach))) {
        sparse.cells[c] = 1;
        any = true;
      }
    if (!any) break;
    const Raster near = dilated(sparse, reach);
    for (std::size_t c = 0; c < full.cells.size(); ++c) full.cells[c] |= near.cells[c] & region.cells[c];
  }
  return full;
}

using Corner = std::pair<int, int>;
using Ring = std::vector<Corner>;

/// Boundary of the full cells as closed rings of grid corners, the inside to the left.
std::vector<Ring> trace(const Raster& r) {
  std::multimap<Corner, Corner> edges;
  for (int y = 0; y < r.height; ++y)
    for (int x = 0; x < r.width; ++x) {
      if (!r.full(x, y)) continue;
      if (!r.full(x, y - 1)) edges.insert({{x, y}, {x + 1, y}});
      if (!r.full(x + 1, y)) edges.insert({{x + 1, y}, {x + 1, y + 1}});
      if (!r.full(x, y + 1)) edges.insert({{x + 1, y + 1}, {x, y + 1}});
      if (!r.full(x - 1, y)) edges.insert({{x, y + 1}, {x, y}});
    }
  std::vector<Ring> rings;
  while (!edges.empty()) {
    const Corner start = edges.begin()->first;
    Corner at = start, came = {0, 0};
    Ring ring;
    do {
      auto [first, last] = edges.equal_range(at);
      auto next = first;
      if (std::next(first) != last) {
        // Two cells touch at this corner: turn left, so that rings do not cross.
        const auto left = [&](const Corner& to) { return came.first * (to.second - at.second) - came.second * (to.first - at.first); };
        for (auto it = first; it != last; ++it)
          if (left(it->second) > left(next->second)) next = it;
      }
      const Corner to = next->second;
      const Corner direction = {to.first - at.first, to.second - at.second};
      if (direction != came || ring.empty()) ring.push_back(at);
      came = direction;
      edges.erase(next);
      at = to;
    } while (at != start);
    rings.push_back(std::move(ring));
  }
  return rings;
}

double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += static_cast<double>(a.first) * b.second - static_cast<double>(b.first) * a.second;
  }
  return sum;
}

/// Douglas–Peucker on an open chain, ends kept.
void simplify(const Ring& chain, std::size_t first, std::size_t last, double tolerance, Ring& out) {
  const Vec2 a(chain[first].first, chain[first].second), b(chain[last].first, chain[last].second);
  const Vec2 along = (b - a).norm() > 0 ? Vec2((b - a).normalized()) : Vec2(1, 0);
  double farthest = tolerance;
  std::size_t split = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 d = Vec2(chain[i].first, chain[i].second) - a;
    const double distance = (b - a).norm() > 0 ? std::abs(along.x() * d.y() - along.y() * d.x()) : d.norm();
    if (distance > farthest) {
      farthest = distance;
      split = i;
    }
  }
  if (split == 0) {
    out.push_back(chain[last]);
    return;
  }
  simplify(chain, first, split, tolerance, out);
  simplify(chain, split, last, tolerance, out);
}

Ring simplified(const Ring& ring, double tolerance) {
  // Cut where the ring is widest, so that the cut is a true corner.
  std::size_t far = 0, start = 0;
  double widest = -1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double d = std::hypot(ring[i].first - ring[0].first, ring[i].second - ring[0].second);
    if (d > widest) {
      widest = d;
      start = i;
    }
  }
  Ring chain(ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
  chain.insert(chain.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start) + 1);
  widest = -1;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const double d = std::hypot(chain[i].first - chain[0].first, chain[i].second - chain[0].second);
    if (d > widest) {
      widest = d;
      far = i;
    }
  }
  Ring out;
  simplify(chain, 0, far, tolerance, out);
  simplify(chain, far, chain.size() - 1, tolerance, out);
  return out;
}

}  // namespace

Polygon outline(const std::vector<Vec3>& points, const Plane& plane, const Vec3& u, double cell) {
  if (points.empty()) return {};
  const Vec3 v = plane.normal.cross(u);
  const Vec3 origin = plane.project(points.front());
  Vec2 low(0, 0), high(0, 0);
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points) {
    flat.emplace_back(u.dot(p - origin), v.dot(p - origin));
    low = low.cwiseMin(flat.back());
    high = high.cwiseMax(flat.back());
  }
  cell = std::max(cell, (high - low).maxCoeff() / kLargestRaster);
  // Gaps are closed a little wider until nearly all points lie in one part.
  const int margin = kWidest + 1;
  const Raster points_raster = rasterize(flat, low, high, cell, margin), where_sparse = filled_where_sparse(points_raster);
  Raster raster;
  for (int radius = 2; radius <= kWidest; radius *= 2) {
    raster = closed(points_raster, radius);
    for (std::size_t c = 0; c < raster.cells.size(); ++c) raster.cells[c] |= where_sparse.cells[c];
    keep_largest(raster);
    std::size_t marked = 0, inside = 0;
    for (std::size_t c = 0; c < raster.cells.size(); ++c) {
      marked += points_raster.cells[c];
      inside += raster.cells[c] && points_raster.cells[c];
    }
    if (10 * inside >= 9 * marked) break;
  }
  std::vector<Ring> rings = trace(raster);
  std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return twice_area(a) > twice_area(b); });
  Polygon polygon;
  for (const Ring& ring : rings) {
    if (!polygon.empty() && twice_area(ring) > -2.0 * 12) continue;  // holes of less than 12 cells are gaps
    Ring corners = simplified(ring, 1.0);
    if (corners.size() < 3) corners = ring;  // a strip of one cell
    std::vector<Vec3> loop;
    for (const Corner& c : corners)
      loop.push_back(origin + (low.x() + (c.first - margin) * cell) * u + (low.y() + (c.second - margin) * cell) * v);
    polygon.push_back(std::move(loop));
  }
  return polygon;
}

double area_of(const Polygon& polygon, const Vec3& normal) {
  double sum = 0;
  for (const std::vector<Vec3>& ring : polygon)
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum += 0.5 * normal.dot((ring[i] - ring[0]).cross(ring[(i + 1) % ring.size()] - ring[0]));
  return sum;
}

}  // namespace unseen::planes
