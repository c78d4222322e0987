// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/outline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace unseen::planes {
namespace {

constexpr int kLargestRaster = 1500;  // cells along an edge; larger planes get larger cells
constexpr int kWidest = 16;           // cells, that gaps are closed by at most
constexpr int kFewNear = 14;           // cells with points within reach of one that is sparse: where there are more, chance leaves few gaps that half the reach does not close

struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cells;

  std::uint8_t& at(int x, int y) { return cells[static_cast<std::size_t>(y) * width + x]; }
  bool full(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && cells[static_cast<std::size_t>(y) * width + x] != 0;
  }
};

/// Marks the cells in which points lie, with `margin` empty cells around all.
Raster rasterize(const std::vector<Vec2>& points, const Vec2& low, const Vec2& high, double cell, int margin) {
  Raster r;
  r.width = static_cast<int>((high - low).x() / cell) + 1 + 2 * margin;
  r.height = static_cast<int>((high - low).y() / cell) + 1 + 2 * margin;
  r.cells.assign(static_cast<std::size_t>(r.width) * r.height, 0);
  for (const Vec2& p : points) r.at(static_cast<int>((p - low).x() / cell) + margin, static_cast<int>((p - low).y() / cell) + margin) = 1;
  return r;
}

/// Each cell combined with those within `radius` along both axes; `nothing` lies outside. Windows are put together from halves (van Herk), so that a
/// pass over the cells takes few steps, for 16 cells at a time.
template <class Combine>
Raster combined(const Raster& r, int radius, std::uint8_t nothing, Combine combine) {
  const std::size_t window = 2 * static_cast<std::size_t>(radius) + 1;
  Raster to = r;
  const auto slide = [&](std::size_t stride, std::size_t count, std::vector<std::uint8_t>& padded, std::uint8_t* out) {  // over `count` rows of `stride` cells
    std::size_t width = 1;
    for (; 2 * width <= window; width *= 2)
      for (std::size_t i = 0, end = padded.size() - width * stride; i < end; ++i) padded[i] = combine(padded[i], padded[i + width * stride]);
    const std::size_t second = (window - width) * stride;
    for (std::size_t i = 0; i < count * stride; ++i) out[i] = combine(padded[i], padded[i + second]);
  };
  const std::size_t width = static_cast<std::size_t>(r.width), height = static_cast<std::size_t>(r.height);
  std::vector<std::uint8_t> padded;
  for (std::size_t y = 0; y < height; ++y) {
    padded.assign(width + window - 1, nothing);
    std::copy_n(r.cells.begin() + static_cast<std::ptrdiff_t>(y * width), width, padded.begin() + radius);
    slide(1, width, padded, &to.cells[y * width]);
  }
  padded.assign((height + window - 1) * width, nothing);
  std::copy(to.cells.begin(), to.cells.end(), padded.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(radius) * width));
  slide(width, height, padded, to.cells.data());
  return to;
}

Raster dilated(const Raster& r, int radius) {
  return combined(r, radius, 0, [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
}

/// Fills gaps of up to twice `radius` between full cells.
Raster closed(const Raster& r, int radius) {
  return combined(dilated(r, radius), radius, 1, [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a & b); });
}

/// How many cells are full in any rectangle, by sums from the first corner.
class Counts {
 public:
  explicit Counts(const Raster& r) : width_(r.width), height_(r.height), sums_(static_cast<std::size_t>(r.width + 1) * (r.height + 1), 0) {
    for (int y = 0; y < r.height; ++y)
      for (int x = 0, row = 0; x < r.width; ++x) {
        row += r.cells[static_cast<std::size_t>(y) * r.width + x];
        sum(x + 1, y + 1) = sum(x + 1, y) + row;
      }
  }
  /// Within `reach` of a cell along both axes.
  int around(int x, int y, int reach) const {
    const int x0 = std::max(0, x - reach), y0 = std::max(0, y - reach), x1 = std::min(width_, x + reach + 1), y1 = std::min(height_, y + reach + 1);
    return sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0);
  }

 private:
  int& sum(int x, int y) { return sums_[static_cast<std::size_t>(y) * (width_ + 1) + x]; }
  int sum(int x, int y) const { return sums_[static_cast<std::size_t>(y) * (width_ + 1) + x]; }

  int width_, height_;
  std::vector<int> sums_;
};

/// The full cells that have few others within `reach`, for as much of that as is in `region`.
Raster sparse_cells(const Raster& r, const Counts& counts, const Counts& region, int reach) {
  const double window = (2.0 * reach + 1) * (2.0 * reach + 1);
  Raster sparse = r;
  for (std::size_t c = 0; c < r.cells.size(); ++c) {
    if (!r.cells[c]) continue;
    const int x = static_cast<int>(c % r.width), y = static_cast<int>(c / r.width);
    sparse.cells[c] = window * counts.around(x, y, reach) <= kFewNear * static_cast<double>(region.around(x, y, reach));
  }
  return sparse;
}

bool is_empty(const Raster& r) { return std::find(r.cells.begin(), r.cells.end(), 1) == r.cells.end(); }

/// What lies between full cells where these are sparse: gaps of up to twice the reach within which they have few others.
Raster filled_where_sparse(const Raster& points) {
  const Counts counts(points);
  Raster full = points;
  for (int reach = 4; reach <= kWidest; reach *= 2) {
    const Raster region = closed(points, reach), sparse = sparse_cells(points, counts, Counts(region), reach);
    if (is_empty(sparse)) break;
    const Raster near = dilated(sparse, reach);
    for (std::size_t c = 0; c < full.cells.size(); ++c) full.cells[c] |= near.cells[c] & region.cells[c];
  }
  return full;
}

/// Keeps the largest part connected by edges; returns how many cells it has.
std::size_t keep_largest(Raster& r) {
  std::vector<int> part(r.cells.size(), -1);
  std::vector<std::size_t> size;
  std::vector<std::size_t> stack;
  for (std::size_t s = 0; s < r.cells.size(); ++s) {
    if (!r.cells[s] || part[s] >= 0) continue;
    const int id = static_cast<int>(size.size());
    size.push_back(0);
    part[s] = id;
    stack = {s};
    while (!stack.empty()) {
      const std::size_t c = stack.back();
      stack.pop_back();
      ++size[id];
      const int x = static_cast<int>(c % r.width), y = static_cast<int>(c / r.width);
      for (const auto& [nx, ny] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
        if (r.full(nx, ny) && part[static_cast<std::size_t>(ny) * r.width + nx] < 0) {
          part[static_cast<std::size_t>(ny) * r.width + nx] = id;
          stack.push_back(static_cast<std::size_t>(ny) * r.width + nx);
        }
    }
  }
  if (size.empty()) return 0;
  const int keep = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  for (std::size_t c = 0; c < r.cells.size(); ++c) r.cells[c] = part[c] == keep;
  return size[keep];
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
