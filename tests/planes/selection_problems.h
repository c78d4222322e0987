// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <limits>

#include "planes/selection/select.h"
#include "planes/selection/selection.h"
#include "unseen/core/random.h"

namespace unseen::planes::test {

inline const Context kContext;

/// A selection problem like those of scenes: patches cluster about a few true frames, further frames resemble
/// these, some pairs have no candidate. Every patch has its own local fit among the candidates.
inline SelectionProblem random_problem(int patches, int frames, double lambda, int fixed,
                                       std::uint64_t seed) {
  Random random(seed);
  SelectionProblem p;
  p.lambda = lambda;
  const int all = frames + patches;  // the last ones are local fits
  std::vector<double> angle;
  for (int k = 0; k < frames; ++k) angle.push_back(random.uniform(0, 45));
  p.data = Table<double>(patches, all, 0.0);
  p.orientation = Table<int>(patches, all, -1);
  for (int j = 0; j < patches; ++j) {
    const double own = angle[random.index(frames)] + 1.5 * random.normal(), sigma = random.uniform(0.5, 3);
    angle.push_back(own);
    for (int k = 0; k < all; ++k) {
      const double off = k < frames ? std::abs(angle[k] - own) : 2.0 * random.uniform();
      const bool possible = k == frames + j || (k < frames && (off < 15 || k < fixed));
      p.data(j, k) = possible ? (k == frames + j ? 0.0 : off * off / (sigma * sigma) / 9)
                              : std::numeric_limits<double>::infinity();
      p.orientation(j, k) = possible ? 2 * k + static_cast<int>(random.index(2)) : -1;
    }
    for (int o = 0; o < j; ++o)
      if (random.uniform() < 3.0 / patches) p.neighbours.emplace_back(o, j);
  }
  p.irregularity = Table<double>(all, all, 0.0);
  for (int a = 0; a < all; ++a)
    for (int b = 0; b < a; ++b) {
      const double x = angle.size() > static_cast<std::size_t>(a) ? std::abs(angle[a] - angle[b]) : 10;
      p.irregularity(a, b) = p.irregularity(b, a) = 1 - std::exp(-3 * x * 3.14159 / 180);
    }
  p.fixed.assign(all, 0);
  for (int k = 0; k < fixed; ++k) p.fixed[k] = 1;
  return p;
}

/// The energy as the design states it, written without the code under test.
inline double energy_by_definition(const SelectionProblem& p, const Labels& labels) {
  double sum = 0;
  std::vector<int> chosen;
  for (int k = 0; k < p.frames(); ++k) {
    bool is_chosen = p.fixed[k] != 0;
    for (const int l : labels) is_chosen = is_chosen || l == k;
    if (is_chosen) chosen.push_back(k);
  }
  for (std::size_t j = 0; j < labels.size(); ++j) sum += p.lambda * p.data(static_cast<int>(j), labels[j]);
  double pairs = 0;
  for (const int a : chosen)
    for (const int b : chosen) pairs += 0.5 * p.irregularity(a, b);
  const double cost = std::min({pairs, 4 + pairs / 2, 12 + pairs / 4, 28 + pairs / 8, 60 + pairs / 16});
  sum += (1 - p.lambda) * cost;
  for (const auto& [a, b] : p.neighbours)
    sum += (1 - p.lambda) / 10 * (p.orientation(a, labels[a]) != p.orientation(b, labels[b]));
  return sum;
}

}  // namespace unseen::planes::test
