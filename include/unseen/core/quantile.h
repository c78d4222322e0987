// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace unseen {

/// The value of `rank`, counted from 0 in rising order; 0 of nothing.
template <class T>
T ranked(std::vector<T> values, std::size_t rank) {
  if (values.empty()) return T{};
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The value that this share (0…1) of the others lies below, or the next smaller one; 0 of nothing.
template <class T>
T quantile(std::vector<T> values, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - std::min<std::size_t>(1, values.size())));
  return ranked(std::move(values), rank);
}

/// The upper median; 0 of nothing.
template <class T>
T median(std::vector<T> values) {
  const std::size_t rank = values.size() / 2;
  return ranked(std::move(values), rank);
}

}  // namespace unseen
