// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "planes/selection.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr double kImpossible = 1e4;  // stands for an infinite cost, so that differences stay numbers
constexpr int kSubsetFrames = 10;   // all subsets of this many frames are tried …
constexpr std::size_t kSubsetBlock = 128;  // subsets that one thread tries
constexpr int kSubsetPatches = 80;  // … for problems up to this size
constexpr int kShakes = 3, kStartsOfShake = 4;  // times that the best is shaken, starts from it each time
constexpr std::size_t kSwaps = 24;  // frames that may replace another, the most promising ones

/// A problem with what the search asks for again and again.
class Search {
 public:
  Search(const SelectionProblem& problem, const Context& context)
      : p_(problem),
        context_(context),
        offers_(offers_of(problem)),
        cost_((problem.lambda * problem.data).cwiseMin(kImpossible)),
        irregularity_((1.0 - problem.lambda) * problem.irregularity),
        near_(problem.patches()) {
    for (const auto& [a, b] : p_.neighbours) {
      near_[a].push_back(b);
      near_[b].push_back(a);
    }
  }

  struct State {
    std::vector<int> open;
    Labels labels;
    double energy = std::numeric_limits<double>::infinity();
  };

  std::vector<int> fixed() const {
    std::vector<int> open;
    for (int k = 0; k < p_.frames(); ++k)
      if (p_.fixed[k]) open.push_back(k);
    return open;
  }

  /// Adds, drops or swaps the frame that gains most, again and again, judging by data and irregularity alone.
  std::vector<int> open_frames(std::vector<int> open) const {
    while (true) {
      context_.check();
      const Best now = best_of(open);
      const std::vector<double> opening = openings(open);
      double best = -1e-8;
      int add = -1, drop = -1;
      const std::vector<std::pair<double, int>> additions = ranked_additions(open, now, opening);
      if (!additions.empty() && additions.front().first < best) {
        best = additions.front().first;
        add = additions.front().second;
      }
      for (const int o : open) {
        if (p_.fixed[o] || open.size() == 1) continue;
        std::vector<double> left = now.cost;
        double without = -opening[o];  // irregularity(o, o) is zero
        for (const Offer& offer : offers_[o])
          if (now.frame[offer.patch] == o) {
            left[offer.patch] = now.second[offer.patch];
            without += now.second[offer.patch] - now.cost[offer.patch];
          }
        if (without < best) {
          best = without;
          add = -1;
          drop = o;
        }
        for (const auto& [gain, k] : additions) {
          const double change = without + opening[k] - irregularity_(o, k) - saved(k, left);
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

  /// Labels a set of frames and closes those that no patch took. The energy stays infinite where all these
  /// frames could not get below `upper` even without smoothness.
  State evaluate(const std::vector<int>& open, double upper = std::numeric_limits<double>::infinity()) const {
    State s;
    Best now = best_of(open);
    double bound = std::accumulate(now.cost.begin(), now.cost.end(), 0.0);
    for (std::size_t a = 0; a < open.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) bound += irregularity_(open[a], open[b]);
    if (bound >= upper) return s;
    s.labels = std::move(now.frame);
    relax(open, s.labels);
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
        State s = evaluate(open, best.energy - 1e-8);
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
    std::vector<int> result;
    for (const auto& [change, k] : ranked_additions(open, best_of(open), openings(open)))
      if (result.size() < count) result.push_back(k);
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
    const std::vector<int> base = fixed();
    const std::size_t sets = std::size_t{1} << pool.size();
    std::vector<State> best_of_block((sets + kSubsetBlock - 1) / kSubsetBlock, state);
    parallel_blocks(context_, best_of_block.size(), 1, [&](std::size_t block, std::size_t) {
      State& best = best_of_block[block];
      for (std::size_t set = block * kSubsetBlock; set < std::min(sets, (block + 1) * kSubsetBlock); ++set) {
        std::vector<int> open = base;
        for (std::size_t i = 0; i < pool.size(); ++i)
          if (set >> i & 1) open.push_back(pool[i]);
        if (open.empty()) continue;
        State s = evaluate(open, best.energy - 1e-8);
        if (s.energy < best.energy - 1e-8) best = std::move(s);
      }
    });
    State best = state;
    for (State& s : best_of_block)
      if (s.energy < best.energy - 1e-8) best = std::move(s);
    return best;
  }

 private:
  /// What open frames offer each patch at best: the frame, its cost, and what is left if it goes.
  struct Best {
    Labels frame;  ///< the first open one where none offers anything
    std::vector<double> cost, second;
  };
  Best best_of(const std::vector<int>& open) const {
    const std::vector<double> nothing(p_.patches(), kImpossible);
    Best best{Labels(p_.patches(), open.empty() ? -1 : open.front()), nothing, nothing};
    for (const int k : open)
      for (const Offer& o : offers_[k])
        if (o.cost < best.cost[o.patch]) {
          best.second[o.patch] = best.cost[o.patch];
          best.cost[o.patch] = o.cost;
          best.frame[o.patch] = k;
        } else if (o.cost < best.second[o.patch]) {
          best.second[o.patch] = o.cost;
        }
    return best;
  }

  /// Irregularity that opening each frame adds beside the open ones.
  std::vector<double> openings(const std::vector<int>& open) const {
    std::vector<double> sum(p_.frames(), 0.0);
    for (const int o : open)
      for (int k = 0; k < p_.frames(); ++k) sum[k] += irregularity_(k, o);
    return sum;
  }

  /// Data cost that a frame takes off what patches pay now.
  double saved(int k, const std::vector<double>& now) const {
    double sum = 0;
    for (const Offer& o : offers_[k]) sum += std::max(0.0, now[o.patch] - o.cost);
    return sum;
  }

  /// Change of data and irregularity by each closed frame, the best kSwaps, best first.
  std::vector<std::pair<double, int>> ranked_additions(const std::vector<int>& open, const Best& now,
                                                       const std::vector<double>& opening) const {
    std::vector<char> is_open(p_.frames(), 0);
    for (const int k : open) is_open[k] = 1;
    std::vector<std::pair<double, int>> ranked;
    for (int k = 0; k < p_.frames(); ++k)
      if (!is_open[k]) ranked.emplace_back(opening[k] - saved(k, now.cost), k);
    const auto middle = ranked.begin() + static_cast<std::ptrdiff_t>(std::min(kSwaps, ranked.size()));
    std::partial_sort(ranked.begin(), middle, ranked.end());
    ranked.erase(middle, ranked.end());
    return ranked;
  }

  double differs(int a, int ka, int b, int kb) const {
    return p_.orientation(a, ka) == p_.orientation(b, kb) ? 0.0 : p_.smoothness();
  }

  double total(const std::vector<int>& open, const Labels& labels) const {
    double sum = 0;
    for (std::size_t a = 0; a < open.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) sum += irregularity_(open[a], open[b]);
    for (int j = 0; j < p_.patches(); ++j) sum += cost_(j, labels[j]);
    for (const auto& [a, b] : p_.neighbours) sum += differs(a, labels[a], b, labels[b]);
    return sum;
  }

  /// Moves of patches and of connected parts of one orientation, until none lowers the energy.
  void relax(const std::vector<int>& open, Labels& labels) const {
    if (p_.neighbours.empty() || p_.smoothness() == 0.0) return;
    std::vector<char> inside(p_.patches(), 0);
    for (int sweep = 0; sweep < 20; ++sweep) {
      bool changed = false;
      for (int j = 0; j < p_.patches(); ++j) changed = move({&j, 1}, open, inside, labels) || changed;
      for (const std::vector<int>& part : parts(labels))
        if (part.size() > 1) changed = move(part, open, inside, labels) || changed;
      if (!changed) break;
    }
  }

  /// Gives a set of patches the one frame that lowers the energy most, if any does. `inside` is all zero.
  bool move(std::span<const int> part, const std::vector<int>& open, std::vector<char>& inside, Labels& labels) const {
    for (const int j : part) inside[j] = 1;
    double pays = 0;  // smoothness within the part stays as it is: zero
    for (const int j : part) {
      pays += cost_(j, labels[j]);
      for (const int n : near_[j])
        if (!inside[n]) pays += differs(j, labels[j], n, labels[n]);
    }
    double best = pays - 1e-12;
    int to = -1;
    for (const int k : open) {
      double sum = 0;
      for (const int j : part) sum += cost_(j, k);
      for (std::size_t i = 0; sum < best && i < part.size(); ++i)
        for (const int n : near_[part[i]])
          if (inside[n]) {
            sum += 0.5 * differs(part[i], k, n, k);
          } else {
            sum += differs(part[i], k, n, labels[n]);
          }
      if (sum < best) {
        best = sum;
        to = k;
      }
    }
    for (const int j : part) inside[j] = 0;
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

  const SelectionProblem& p_;
  const Context& context_;
  const Offers offers_;
  const Eigen::MatrixXd cost_;          ///< λ·D, patches × frames, with kImpossible for infinite
  const Eigen::MatrixXd irregularity_;  ///< (1−λ)·Irr
  std::vector<std::vector<int>> near_;
};

}  // namespace

Offers offers_of(const SelectionProblem& problem) {
  Offers offers(problem.frames());
  for (int k = 0; k < problem.frames(); ++k)
    for (int j = 0; j < problem.patches(); ++j)
      if (std::isfinite(problem.data(j, k))) offers[k].push_back({j, problem.lambda * problem.data(j, k)});
  return offers;
}

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
  const auto attempt = [&](std::vector<std::vector<int>> starts) {
    std::vector<Search::State> found(starts.size());
    parallel_blocks(context, starts.size(), 1, [&](std::size_t i, std::size_t) {
      found[i] = search.improve(search.evaluate(search.open_frames(std::move(starts[i]))));
    });
    for (Search::State& s : found)
      if (s.energy < best.energy - 1e-8) best = std::move(s);
  };
  std::vector<std::vector<int>> starts = {fixed};
  if (!start.empty()) {
    std::vector<int> open = fixed;
    for (const int k : start)
      if (std::find(open.begin(), open.end(), k) == open.end()) open.push_back(k);
    starts.push_back(std::move(open));
  }
  const bool small = problem.patches() <= kSubsetPatches;
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
