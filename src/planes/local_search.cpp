// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "planes/selection.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr double kImpossible = 1e4;  // stands for an infinite cost, so that differences stay numbers
constexpr int kSubsetFrames = 10;   // all subsets of this many frames are tried …
constexpr int kSubsetPatches = 80;  // … for problems up to this size
constexpr int kShakes = 12;          // random starts
constexpr std::size_t kSwaps = 24;  // frames that may replace another, the most promising ones

/// A problem with what the search asks for again and again.
class Search {
 public:
  Search(const SelectionProblem& problem, const Context& context)
      : p_(problem), context_(context), near_(problem.patches()) {
    for (const auto& [a, b] : p_.neighbours) {
      near_[a].push_back(b);
      near_[b].push_back(a);
    }
  }

  double cost(int j, int k) const {
    const double d = p_.data(j, k);
    return std::isfinite(d) ? p_.lambda * d : kImpossible;
  }

  double opening(const std::vector<int>& open, int k) const {
    double sum = 0;
    for (const int o : open) sum += p_.irregularity(o, k);
    return (1.0 - p_.lambda) * sum;
  }

  double total(const std::vector<int>& open, const Labels& labels) const {
    double sum = 0;
    for (std::size_t a = 0; a < open.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) sum += (1.0 - p_.lambda) * p_.irregularity(open[a], open[b]);
    for (int j = 0; j < p_.patches(); ++j) sum += cost(j, labels[j]);
    for (const auto& [a, b] : p_.neighbours) sum += differs(a, labels[a], b, labels[b]);
    return sum;
  }

  double differs(int a, int ka, int b, int kb) const {
    return p_.orientation(a, ka) == p_.orientation(b, kb) ? 0.0 : p_.smoothness();
  }

  /// Labels for a set of open frames: cheapest data first, then moves of patches and of connected parts of one
  /// orientation, until none lowers the energy.
  Labels label(const std::vector<int>& open) const {
    Labels labels(p_.patches());
    for (int j = 0; j < p_.patches(); ++j)
      labels[j] = *std::min_element(open.begin(), open.end(), [&](int a, int b) { return cost(j, a) < cost(j, b); });
    if (p_.neighbours.empty() || p_.smoothness() == 0.0) return labels;
    for (int sweep = 0; sweep < 20; ++sweep) {
      bool changed = false;
      for (int j = 0; j < p_.patches(); ++j) changed = move({j}, open, labels) || changed;
      for (const std::vector<int>& part : parts(labels))
        if (part.size() > 1) changed = move(part, open, labels) || changed;
      if (!changed) break;
    }
    return labels;
  }

  /// Gives a set of patches the one frame that lowers the energy most, if any does.
  bool move(const std::vector<int>& part, const std::vector<int>& open, Labels& labels) const {
    std::vector<char> inside;
    if (part.size() > 1) {
      inside.assign(labels.size(), 0);
      for (const int j : part) inside[j] = 1;
    }
    const auto local = [&](int k) {  // k < 0: as it is
      double sum = 0;
      for (const int j : part) {
        const int kj = k < 0 ? labels[j] : k;
        sum += cost(j, kj);
        for (const int n : near_[j]) {
          const bool in = part.size() > 1 ? inside[n] != 0 : n == j;
          const int kn = in && k >= 0 ? k : labels[n];
          sum += (in ? 0.5 : 1.0) * differs(j, kj, n, kn);
        }
      }
      return sum;
    };
    double best = local(-1) - 1e-12;
    int to = -1;
    for (const int k : open)
      if (const double sum = local(k); sum < best) {
        best = sum;
        to = k;
      }
    if (to < 0) return false;
    for (const int j : part) labels[j] = to;
    return true;
  }

  std::vector<std::vector<int>> parts(const Labels& labels) const {
    std::vector<char> seen(labels.size(), 0);
    std::vector<std::vector<int>> result;
    for (std::size_t j = 0; j < labels.size(); ++j) {
      if (seen[j]) continue;
      seen[j] = 1;
      std::vector<int> part = {static_cast<int>(j)};
      for (std::size_t at = 0; at < part.size(); ++at)
        for (const int n : near_[part[at]])
          if (!seen[n] && differs(part[at], labels[part[at]], n, labels[n]) == 0.0) {
            seen[n] = 1;
            part.push_back(n);
          }
      result.push_back(std::move(part));
    }
    return result;
  }

  std::vector<int> fixed() const {
    std::vector<int> open;
    for (int k = 0; k < p_.frames(); ++k)
      if (p_.fixed[k]) open.push_back(k);
    return open;
  }

  /// What the open frames offer each patch: the cheapest, and what is left if that one goes.
  struct Offers {
    std::vector<int> first;
    std::vector<double> best, second;
  };
  Offers offers(const std::vector<int>& open) const {
    Offers o{std::vector<int>(p_.patches(), -1), std::vector<double>(p_.patches(), kImpossible),
             std::vector<double>(p_.patches(), kImpossible)};
    for (const int k : open)
      for (int j = 0; j < p_.patches(); ++j) {
        const double c = cost(j, k);
        if (c < o.best[j]) {
          o.second[j] = o.best[j];
          o.best[j] = c;
          o.first[j] = k;
        } else if (c < o.second[j]) {
          o.second[j] = c;
        }
      }
    return o;
  }

  /// Adds, drops or swaps the frame that gains most, again and again, judging by data and irregularity alone.
  std::vector<int> open_frames(std::vector<int> open) const {
    while (true) {
      context_.check();
      const Offers now = offers(open);
      double best = -1e-8;
      int add = -1, drop = -1;
      std::vector<std::pair<double, int>> additions;
      for (int k = 0; k < p_.frames(); ++k) {
        if (std::find(open.begin(), open.end(), k) != open.end()) continue;
        double change = opening(open, k);
        for (int j = 0; j < p_.patches(); ++j) change += std::min(0.0, cost(j, k) - now.best[j]);
        additions.emplace_back(change, k);
        if (change < best) {
          best = change;
          add = k;
          drop = -1;
        }
      }
      std::sort(additions.begin(), additions.end());
      if (additions.size() > kSwaps) additions.resize(kSwaps);
      for (const int o : open) {
        if (p_.fixed[o] || open.size() == 1) continue;
        std::vector<double> left = now.best;
        double without = -opening(open, o);  // irregularity(o, o) is zero
        for (int j = 0; j < p_.patches(); ++j)
          if (now.first[j] == o) {
            left[j] = now.second[j];
            without += now.second[j] - now.best[j];
          }
        if (without < best) {
          best = without;
          add = -1;
          drop = o;
        }
        for (const auto& [gain, k] : additions) {
          double change = without + opening(open, k) - (1.0 - p_.lambda) * p_.irregularity(o, k);
          for (int j = 0; j < p_.patches(); ++j) change += std::min(0.0, cost(j, k) - left[j]);
          if (change < best) {
            best = change;
            add = k;
            drop = o;
          }
        }
      }
      if (add < 0 && drop < 0) return open;
      if (drop >= 0) std::erase(open, drop);
      if (add >= 0) open.push_back(add);
    }
  }

  struct State {
    std::vector<int> open;
    Labels labels;
    double energy = std::numeric_limits<double>::infinity();
  };

  /// Labels a set of frames and closes those that no patch took.
  State evaluate(const std::vector<int>& open) const {
    State s;
    s.labels = label(open);
    std::vector<char> used(p_.frames(), 0);
    for (const int k : s.labels) used[k] = 1;
    for (const int k : open)
      if (used[k] || p_.fixed[k]) s.open.push_back(k);
    s.energy = total(s.open, s.labels);
    return s;
  }

  /// Adds and drops one frame at a time while that lowers the whole energy.
  State improve(State state) const {
    for (int round = 0; round < 10; ++round) {
      context_.check();
      State best = state;
      const auto attempt = [&](const std::vector<int>& open) {
        if (open.empty()) return;
        State s = evaluate(open);
        if (s.energy < best.energy - 1e-8) best = std::move(s);
      };
      for (const int k : state.open) {
        if (p_.fixed[k]) continue;
        std::vector<int> rest = state.open;
        std::erase(rest, k);
        attempt(rest);
      }
      for (const int other : promising(state.open, 4)) {
        std::vector<int> grown = state.open;
        grown.push_back(other);
        attempt(grown);
      }
      if (!(best.energy < state.energy - 1e-8)) return state;
      state = std::move(best);
    }
    return state;
  }

  /// The closed frames whose opening beside `open` changes data and irregularity for the better, best first.
  std::vector<int> promising(const std::vector<int>& open, std::size_t count) const {
    const Offers now = offers(open);
    std::vector<std::pair<double, int>> ranked;
    for (int k = 0; k < p_.frames(); ++k) {
      if (std::find(open.begin(), open.end(), k) != open.end()) continue;
      double change = opening(open, k);
      for (int j = 0; j < p_.patches(); ++j) change += std::min(0.0, cost(j, k) - now.best[j]);
      ranked.emplace_back(change, k);
    }
    std::sort(ranked.begin(), ranked.end());
    if (ranked.size() > count) ranked.resize(count);
    std::vector<int> result;
    for (const auto& [change, k] : ranked) result.push_back(k);
    return result;
  }

  /// Every subset of the frames that a good solution uses and of those that nearly made it.
  State all_subsets(const State& state) const {
    std::vector<int> pool;
    for (const int k : state.open)
      if (!p_.fixed[k]) pool.push_back(k);
    if (static_cast<int>(pool.size()) > kSubsetFrames) return state;
    const auto widen = [&](const std::vector<int>& beside, std::size_t count) {
      for (const int k : promising(beside, count))
        if (static_cast<int>(pool.size()) < kSubsetFrames && std::find(pool.begin(), pool.end(), k) == pool.end())
          pool.push_back(k);
    };
    for (const int k : state.open) {
      if (p_.fixed[k]) continue;
      std::vector<int> rest = state.open;
      std::erase(rest, k);
      widen(rest, 3);
    }
    widen(state.open, kSubsetFrames);
    State best = state;
    const std::vector<int> base = fixed();
    for (unsigned set = 0; set < 1u << pool.size(); ++set) {
      std::vector<int> open = base;
      for (std::size_t i = 0; i < pool.size(); ++i)
        if (set >> i & 1) open.push_back(pool[i]);
      if (open.empty()) continue;
      if ((set & 63) == 0) context_.check();
      State s = evaluate(open);
      if (s.energy < best.energy - 1e-8) best = std::move(s);
    }
    return best;
  }

 private:
  const SelectionProblem& p_;
  const Context& context_;
  std::vector<std::vector<int>> near_;
};

}  // namespace

Energy energy_of(const SelectionProblem& problem, const Labels& labels) {
  Energy e;
  std::vector<char> open = problem.fixed;
  for (int j = 0; j < problem.patches(); ++j) {
    e.data += problem.lambda * problem.data(j, labels[j]);
    open[labels[j]] = 1;
  }
  for (int a = 0; a < problem.frames(); ++a)
    for (int b = 0; b < a; ++b)
      if (open[a] && open[b]) e.irregularity += (1.0 - problem.lambda) * problem.irregularity(a, b);
  for (const auto& [a, b] : problem.neighbours)
    if (problem.orientation(a, labels[a]) != problem.orientation(b, labels[b])) e.smoothness += problem.smoothness();
  return e;
}

Labels solve_local(const SelectionProblem& problem, const Context& context, const Labels& start) {
  if (problem.patches() == 0) return {};
  const Search search(problem, context);
  const std::vector<int> fixed = search.fixed();
  Search::State best;
  const auto attempt = [&](std::vector<int> open) {
    Search::State s = search.improve(search.evaluate(search.open_frames(std::move(open))));
    if (s.energy < best.energy - 1e-8) best = std::move(s);
  };
  attempt(fixed);
  if (!start.empty()) {
    std::vector<int> open = fixed;
    for (const int k : start)
      if (std::find(open.begin(), open.end(), k) == open.end()) open.push_back(k);
    attempt(std::move(open));
  }
  if (problem.patches() > kSubsetPatches) return best.labels;
  // Other starts: from each of the frames that would be best alone, and from what is best so far, shaken.
  for (const int k : search.promising(fixed, 3)) {
    std::vector<int> open = fixed;
    open.push_back(k);
    attempt(std::move(open));
  }
  Random random(1);
  for (int shake = 0; shake < kShakes; ++shake) {
    std::vector<int> open = fixed;
    for (const int k : best.open)
      if (!problem.fixed[k] && random.uniform() < 0.5) open.push_back(k);
    for (int add = 0; add < 3; ++add) {
      const int k = static_cast<int>(random.index(problem.frames()));
      if (std::find(open.begin(), open.end(), k) == open.end()) open.push_back(k);
    }
    attempt(std::move(open));
  }
  return search.improve(search.all_subsets(best)).labels;
}

}  // namespace unseen::planes
