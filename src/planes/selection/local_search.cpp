// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/selection/frame_search.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr int kSmall = 80;  // patches: problems up to this size are searched from more starts
constexpr int kShakes = 3, kStartsOfShake = 4;  // times that the best is shaken, starts from it each time

}  // namespace

Offers offers_of(const SelectionProblem& problem) {
  Offers offers(problem.frames());
  for (int k = 0; k < problem.frames(); ++k)
    for (int j = 0; j < problem.patches(); ++j)
      if (std::isfinite(problem.data(j, k))) offers[k].push_back({j, problem.lambda * problem.data(j, k)});
  return offers;
}

double irregularity_cost(double pairs) {
  double least = pairs;
  for (const Line& line : kIrregularityLines) least = std::min(least, line.at_zero + line.slope * pairs);
  return least;
}

Energy energy_of(const SelectionProblem& problem, const Labels& labels) {
  Energy e;
  std::vector<char> open = problem.fixed;
  for (int j = 0; j < problem.patches(); ++j) {
    e.data += problem.lambda * problem.data(j, labels[j]);
    open[labels[j]] = 1;
  }
  double pairs = 0;
  for (int a = 0; a < problem.frames(); ++a)
    for (int b = 0; b < a; ++b)
      if (open[a] && open[b]) pairs += problem.irregularity(a, b);
  e.irregularity = problem.of_pairs(pairs);
  for (const auto& [a, b] : problem.neighbours)
    if (problem.orientation(a, labels[a]) != problem.orientation(b, labels[b])) e.smoothness += problem.smoothness();
  return e;
}

Labels solve_local(const SelectionProblem& problem, const Context& context, const Labels& start) {
  if (problem.patches() == 0) return {};
  const FrameSearch search(problem, context);
  const std::vector<int> fixed = search.fixed();
  FrameSearch::State best;
  const auto attempt = [&](std::vector<std::vector<int>> starts) {
    std::vector<FrameSearch::State> found(starts.size());
    parallel_blocks(context, starts.size(), 1, [&](std::size_t i, std::size_t) {
      found[i] = search.improve(search.evaluate(search.open_frames(std::move(starts[i]))));
    });
    for (FrameSearch::State& s : found)
      if (s.energy < best.energy - 1e-8) best = std::move(s);
  };
  std::vector<std::vector<int>> starts = {fixed};
  if (!start.empty()) {
    std::vector<int> open = fixed;
    for (const int k : start)
      if (std::find(open.begin(), open.end(), k) == open.end()) open.push_back(k);
    starts.push_back(std::move(open));
  }
  const bool small = problem.patches() <= kSmall;
  // Other starts: from each of the frames that would be best alone, and from what is best so far, shaken.
  for (const int k : search.promising(fixed, small ? 3 : 0)) {
    std::vector<int> open = fixed;
    open.push_back(k);
    starts.push_back(std::move(open));
  }
  attempt(std::move(starts));
  if (!small) return best.labels;
  Random random(1);
  for (int shake = 0; shake < kShakes; ++shake) {
    std::vector<std::vector<int>> shaken;
    for (int i = 0; i < kStartsOfShake; ++i) {
      std::vector<int> open = fixed;
      for (const int k : best.open)
        if (!problem.fixed[k] && random.uniform() < 0.5) open.push_back(k);
      for (int add = 0; add < 3; ++add) {
        const int k = static_cast<int>(random.index(problem.frames()));
        if (std::find(open.begin(), open.end(), k) == open.end()) open.push_back(k);
      }
      shaken.push_back(std::move(open));
    }
    attempt(std::move(shaken));
  }
  return search.improve(search.all_subsets(best)).labels;
}

}  // namespace unseen::planes
