// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::report {

/// Items at points or along segments of a plane, in square cells, so that only those nearby need be looked at.
class FlatGrid {
 public:
  /// For about as many items as there are points, all within their box.
  explicit FlatGrid(const std::vector<Vec2>& points) {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : points) box.extend(p);
    if (points.empty()) box.extend(Vec2(0, 0));
    low_ = box.min();
    const Vec2 size = box.sizes();
    edge_ = std::max(std::sqrt(size.prod() / static_cast<double>(points.size() + 1)), size.maxCoeff() / kMostSide);
    if (!(edge_ > 0)) edge_ = 1.0;
    for (int a = 0; a < 2; ++a) side_[a] = static_cast<int>(size[a] / edge_) + 1;
    cells_.resize(static_cast<std::size_t>(side_[0]) * static_cast<std::size_t>(side_[1]));
  }

  void add(std::size_t item, const Vec2& p) { cells_[cell(column(p.x(), 0), column(p.y(), 1))].push_back(item); }
  void add(std::size_t item, const Vec2& a, const Vec2& b) {
    along(a, b, [&](std::size_t c) {
      cells_[c].push_back(item);
      return false;
    });
  }

  /// True if `test` says so for an item in a cell that the box of three points meets.
  template <class Test>
  bool any(const Vec2& a, const Vec2& b, const Vec2& c, Test test) const {
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int y = column(low.y(), 1); y <= column(high.y(), 1); ++y)
      for (int x = column(low.x(), 0); x <= column(high.x(), 0); ++x)
        if (any_in(cell(x, y), test)) return true;
    return false;
  }
  /// The same along a segment.
  template <class Test>
  bool any(const Vec2& a, const Vec2& b, Test test) const {
    return along(a, b, [&](std::size_t c) { return any_in(c, test); });
  }

  /// Calls test(item) for items added at points, the nearest first and equally near ones in order, until it says true.
  template <class PointOf, class Test>
  void nearest_first(const Vec2& from, PointOf point_of, Test test) const {
    using Waiting = std::pair<double, std::size_t>;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
    const int x = column(from.x(), 0), y = column(from.y(), 1), rings = std::max(side_[0], side_[1]);
    for (int ring = 0; ring <= rings; ++ring) {
      for (int row = std::max(y - ring, 0); row <= std::min(y + ring, side_[1] - 1); ++row)
        for (int c = x - ring; c <= x + ring; c += std::abs(row - y) == ring || ring == 0 ? 1 : 2 * ring)
          if (c >= 0 && c < side_[0])
            for (const std::size_t item : cells_[cell(c, row)]) waiting.emplace((point_of(item) - from).squaredNorm(), item);
      const double reached = ring * edge_;  // all that is nearer than this waits
      for (; !waiting.empty() && (ring == rings || waiting.top().first < reached * reached); waiting.pop())
        if (test(waiting.top().second)) return;
    }
  }

 private:
  static constexpr double kMostSide = 1024;  // cells

  int column(double p, int axis) const { return std::clamp(static_cast<int>((p - low_[axis]) / edge_), 0, side_[axis] - 1); }
  std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_[0]) + static_cast<std::size_t>(x);
  }
  template <class Test>
  bool any_in(std::size_t cell, Test& test) const {
    return std::any_of(cells_[cell].begin(), cells_[cell].end(), test);
  }
  /// Calls f(cell) for the cells that a segment meets, and some beside them, until it says true.
  template <class F>
  bool along(const Vec2& a, const Vec2& b, F f) const {
    const int low = column(std::min(a.y(), b.y()), 1), high = column(std::max(a.y(), b.y()), 1);
    for (int y = low; y <= high; ++y) {
      const auto x_at = [&](int row) {
        const double t = low == high ? 0.0 : (low_.y() + row * edge_ - a.y()) / (b.y() - a.y());
        return a.x() + std::clamp(t, 0.0, 1.0) * (b.x() - a.x());
      };
      const double from = low == high ? a.x() : x_at(y), to = low == high ? b.x() : x_at(y + 1);
      const int first = column(std::min(from, to) - kMargin * edge_, 0), last = column(std::max(from, to) + kMargin * edge_, 0);
      for (int x = first; x <= last; ++x)
        if (f(cell(x, y))) return true;
    }
    return false;
  }
  static constexpr double kMargin = 0.01;  // of a cell, for rounding

  Vec2 low_;
  double edge_;
  int side_[2];
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace unseen::report
