// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/min_cost_flow.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace unseen::interactions {
namespace {
constexpr double kFar = std::numeric_limits<double>::infinity();
}  // namespace

void MinCostFlow::add(std::size_t from, std::size_t to, int capacity, double cost) {
  arcs_[from].push_back({to, arcs_[to].size(), capacity, cost, true});
  arcs_[to].push_back({from, arcs_[from].size() - 1, 0, -cost, false});
}

/// One more path in the residual network: Dijkstra's algorithm on costs that the potentials have made positive.
bool MinCostFlow::augment() {
  const std::size_t goal = arcs_.size() - 1;
  std::vector<double> length(arcs_.size(), kFar);
  std::vector<std::pair<std::size_t, std::size_t>> came(arcs_.size());  // node and arc
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>> open;
  length[0] = 0;
  open.emplace(0.0, 0);
  while (!open.empty()) {
    const auto [so_far, node] = open.top();
    open.pop();
    if (so_far > length[node]) continue;
    for (std::size_t i = 0; i < arcs_[node].size(); ++i) {
      const Arc& arc = arcs_[node][i];
      if (arc.capacity == 0 || potential_[arc.to] == kFar) continue;
      const double next = so_far + std::max(arc.cost + potential_[node] - potential_[arc.to], 0.0);  // below 0 only by rounding
      if (next >= length[arc.to]) continue;
      length[arc.to] = next;
      came[arc.to] = {node, i};
      open.emplace(next, arc.to);
    }
  }
  if (length[goal] == kFar) return false;
  for (std::size_t node = 0; node < arcs_.size(); ++node)
    if (potential_[node] < kFar) potential_[node] += std::min(length[node], length[goal]);
  for (std::size_t node = goal; node != 0; node = came[node].first) {
    Arc& arc = arcs_[came[node].first][came[node].second];
    --arc.capacity;
    ++arcs_[arc.to][arc.back].capacity;
  }
  return true;
}

std::vector<std::vector<std::size_t>> MinCostFlow::paths(int count) {
  potential_.assign(arcs_.size(), kFar);
  potential_[0] = 0;
  for (std::size_t node = 0; node < arcs_.size(); ++node)
    for (const Arc& arc : arcs_[node])
      if (arc.capacity > 0 && potential_[node] < kFar) potential_[arc.to] = std::min(potential_[arc.to], potential_[node] + arc.cost);
  int found = 0;
  while (found < count && augment()) ++found;
  std::vector<std::vector<std::size_t>> paths;
  for (int i = 0; i < found; ++i) {
    std::vector<std::size_t> path = {0};
    while (path.back() != arcs_.size() - 1) {
      auto& arcs = arcs_[path.back()];
      const auto used = std::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.forward && arcs_[a.to][a.back].capacity > 0; });
      --arcs_[used->to][used->back].capacity;
      path.push_back(used->to);
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace unseen::interactions
