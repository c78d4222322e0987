// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace unseen::planes {

/// The value below which values of this share of the weight lie. `weighted`: values and their weights, at least one.
inline double weighted_quantile(std::vector<std::pair<double, double>> weighted, double share) {
  double wanted = 0;
  for (const auto& [value, weight] : weighted) wanted += share * weight;
  auto from = weighted.begin(), to = weighted.end();
  while (to - from > 1) {
    const auto middle = from + (to - from) / 2;
    std::nth_element(from, middle, to);
    double below = 0;
    for (auto it = from; it != middle; ++it) below += it->second;
    if (below >= wanted) {
      to = middle;
    } else {
      wanted -= below;
      from = middle;
    }
  }
  return from->first;
}

}  // namespace unseen::planes
