// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "planes/selection/selection.h"
#include "unseen/core/context.h"

namespace unseen::planes {

/// A selection problem with what the search for good sets of frames asks again and again.
class FrameSearch {
 public:
  FrameSearch(const SelectionProblem& problem, const Context& context);

  struct State {
    std::vector<int> open;
    Labels labels;
    double energy = std::numeric_limits<double>::infinity();
  };

  std::vector<int> fixed() const;

  /// Adds, drops or swaps the frame that gains most, again and again, judging by data and irregularity alone.
  std::vector<int> open_frames(std::vector<int> open) const;

  /// Labels a set of frames and closes those that no patch took. The energy stays infinite where all these
  /// frames could not get below `upper` even without smoothness.
  State evaluate(const std::vector<int>& open, double upper = std::numeric_limits<double>::infinity()) const;

  /// Adds and drops one frame at a time while that lowers the whole energy.
  State improve(State state) const;

  /// The closed frames whose opening beside `open` changes data and irregularity for the better, best first.
  std::vector<int> promising(const std::vector<int>& open, std::size_t count) const;

  /// Every subset of the frames that a good solution uses and of those that nearly made it.
  State all_subsets(const State& state) const;

 private:
  /// What open frames offer each patch at best: the frame, its cost, and what is left if it goes.
  struct Best {
    Labels frame;  ///< the first open one where none offers anything
    std::vector<double> cost, second;
  };
  Best best_of(const std::vector<int>& open) const;

  /// Sum of the irregularities of pairs of frames.
  double pairs_of(const std::vector<int>& open) const;

  /// Irregularities of each frame with the open ones, summed.
  std::vector<double> openings(const std::vector<int>& open) const;

  /// Data cost that each frame takes off what patches pay now. `saves` holds what it was for the costs known before: nothing where all were zero.
  void update_savings(const std::vector<double>& known, const std::vector<double>& now, std::vector<double>& saves) const;

  /// A closed frame, by what opening it changes in data and irregularity, and how much data cost it saves of that.
  struct Addition {
    double change;
    int frame;
    double saves;
    auto operator<=>(const Addition&) const = default;
  };
  /// The most promising additions, best first.
  std::vector<Addition> ranked_additions(const std::vector<int>& open, const std::vector<double>& saves, const std::vector<double>& opening) const;

  double differs(int a, int ka, int b, int kb) const { return p_.orientation(a, ka) == p_.orientation(b, kb) ? 0.0 : p_.smoothness(); }
  double total(const std::vector<int>& open, const Labels& labels) const;

  /// Moves of patches and of connected parts of one orientation, until none lowers the energy.
  void relax(const std::vector<int>& open, Labels& labels) const;

  /// Gives a set of patches the one frame that lowers the energy most, if any does. `inside` is all zero.
  bool move(std::span<const int> part, const std::vector<int>& open, std::vector<char>& inside, Labels& labels) const;

  /// Connected patches of one orientation.
  std::vector<std::vector<int>> parts(const Labels& labels) const;

  const SelectionProblem& p_;
  const Context& context_;
  const Offers offers_;
  Table<double> cost_;                  ///< λ·D, patches × frames, with a large number for infinite
  std::vector<std::vector<int>> near_;
  std::vector<std::vector<std::pair<int, double>>> offers_to_;  ///< of each patch: frame and cost
};

}  // namespace unseen::planes
