// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_path.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace unseen::interactions {
namespace {

constexpr double kNarrow = 0.26;  // m, half of what a person needs
constexpr double kEasy = 0.55;    // m, from furniture that nobody minds

int nearest_free(const FloorPlan& plan, const Vec2& p) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int c = 0; c < plan.columns * plan.rows; ++c) {
    const double distance = (plan.middle(c) - p).norm();
    if (plan.clearance[static_cast<std::size_t>(c)] < kNarrow || distance >= least) continue;
    least = distance;
    best = c;
  }
  return best;
}

/// Dijkstra's algorithm; a metre close to furniture counts as more than one.
std::vector<int> cheapest(const FloorPlan& plan, int from, int to) {
  const std::size_t count = plan.clearance.size();
  std::vector<double> cost(count, std::numeric_limits<double>::infinity());
  std::vector<int> before(count, -1);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  cost[static_cast<std::size_t>(from)] = 0;
  open.push({0.0, from});
  while (!open.empty()) {
    const auto [so_far, c] = open.top();
    open.pop();
    if (c == to) break;
    if (so_far > cost[static_cast<std::size_t>(c)]) continue;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = c % plan.columns + dx, y = c / plan.columns + dy;
        if (x < 0 || y < 0 || x >= plan.columns || y >= plan.rows) continue;
        const auto n = static_cast<std::size_t>(y * plan.columns + x);
        const double clear = plan.clearance[n];
        if (clear < kNarrow) continue;
        const double next = so_far + std::hypot(dx, dy) * (1.0 + 4.0 * std::max(0.0, kEasy - clear));
        if (next >= cost[n]) continue;
        cost[n] = next;
        before[n] = c;
        open.push({next, static_cast<int>(n)});
      }
  }
  if (from != to && before[static_cast<std::size_t>(to)] < 0) return {};
  std::vector<int> cells = {to};
  while (cells.back() != from) cells.push_back(before[static_cast<std::size_t>(cells.back())]);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

std::vector<Vec2> resampled(const std::vector<Vec2>& line, double spacing) {
  std::vector<Vec2> points = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 step = line[i] - line[i - 1];
    const int parts = std::max(1, static_cast<int>(std::lround(step.norm() / spacing)));
    for (int k = 1; k <= parts; ++k) points.push_back(line[i - 1] + step * (static_cast<double>(k) / parts));
  }
  return points;
}

/// Corners of the grid become curves, where there is room for them.
void smooth(const FloorPlan& plan, std::vector<Vec2>& points) {
  for (int round = 0; round < 120; ++round)
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Vec2 next = 0.5 * (points[i - 1] + points[i + 1]);
      if (plan.at(next) >= std::min(kNarrow, plan.at(points[i]))) points[i] = next;
    }
}

}  // namespace

double FloorPlan::at(const Vec2& p) const {
  const long x = std::lround((p.x() - origin.x()) / kCell), y = std::lround((p.y() - origin.y()) / kCell);
  return x < 0 || y < 0 || x >= columns || y >= rows ? 0.0 : clearance[static_cast<std::size_t>(y * columns + x)];
}

FloorPlan plan_floor(const Room& room) {
  FloorPlan plan;
  plan.origin = Vec2(room.floor.left, room.floor.near);
  plan.columns = static_cast<int>((room.floor.right - room.floor.left) / FloorPlan::kCell) + 1;
  plan.rows = static_cast<int>((room.floor.far - room.floor.near) / FloorPlan::kCell) + 1;
  for (int c = 0; c < plan.columns * plan.rows; ++c) {
    const Vec2 p = plan.middle(c);
    double clear = room.floor.contains(p, 0.05) ? 1.0 : 0.0;
    for (const Piece& piece : room.pieces) clear = std::min(clear, ground_distance(piece, p));
    plan.clearance.push_back(clear);
  }
  return plan;
}

std::optional<std::vector<Vec2>> find_path(const FloorPlan& plan, const Vec2& from, const Vec2& to) {
  const int first = nearest_free(plan, from), last = nearest_free(plan, to);
  if (first < 0 || last < 0) return std::nullopt;
  const std::vector<int> cells = cheapest(plan, first, last);
  if (cells.empty()) return std::nullopt;
  std::vector<Vec2> line = {from};
  for (const int c : cells) line.push_back(plan.middle(c));
  line.push_back(to);
  line = resampled(line, 0.05);
  smooth(plan, line);
  return line;
}

}  // namespace unseen::interactions
