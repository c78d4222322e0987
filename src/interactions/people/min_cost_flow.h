// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <vector>

namespace unseen::interactions {

/// A network of unit arcs without directed cycles; nodes are numbered so that every arc leads to a higher number.
class MinCostFlow {
 public:
  explicit MinCostFlow(std::size_t nodes) : arcs_(nodes) {}
  /// `capacity` is 1 or "any number" as far as paths go. Costs may be negative.
  void add(std::size_t from, std::size_t to, int capacity, double cost);
  /// The cheapest `count` paths from the first node to the last: each as its nodes. Exact, by successive shortest paths.
  /// Fewer if no more fit.
  std::vector<std::vector<std::size_t>> paths(int count);

 private:
  struct Arc {
    std::size_t to, back;  ///< back: index of the opposite arc at `to`
    int capacity;
    double cost;
    bool forward;
  };
  bool augment();
  std::vector<std::vector<Arc>> arcs_;
  std::vector<double> potential_;
};

}  // namespace unseen::interactions
