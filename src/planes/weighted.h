// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace unseen::planes {

/// The value below which values of this share of the weight lie. `weighted`: values and their weights, at least one.
inline double weighted_quantile(std::vector<std::pair<double, double>> weighted, double share) {
  std::sort(weighted.begin(), weighted.end());
  double all = 0, below = 0;
  for (const auto& [value, weight] : weighted) all += weight;
  for (const auto& [value, weight] : weighted)
    if ((below += weight) >= share * all) return value;
  return weighted.back().first;
}

}  // namespace unseen::planes
