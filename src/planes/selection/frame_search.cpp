// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/frame_search.h"

#include <algorithm>
#include <numeric>

namespace unseen::planes {
namespace {

constexpr double kImpossible = 1e4;  // stands for an infinite cost, so that differences stay numbers
constexpr int kSubsetFrames = 10;    // all subsets of this many frames are tried …
constexpr std::size_t kSubsetBlock = 128;  // … one thread takes this many of them
constexpr std::size_t kSwaps = 24;  // frames that may replace another, the most promising ones

}  // namespace

FrameSearch::FrameSearch(const SelectionProblem& problem, const Context& context)
    : p_(problem),
      context_(context),
      offers_(offers_of(problem)),
      cost_(problem.data),
      near_(problem.patches()),
      offers_to_(problem.patches()) {
  cost_.transform([&](double data) { return std::min(p_.lambda * data, kImpossible); });
  for (int k = 0; k < p_.frames(); ++k)
    for (const Offer& o : offers_[k]) offers_to_[o.patch].emplace_back(k, o.cost);
  for (const auto& [a, b] : p_.neighbours) {
    near_[a].push_back(b);
    near_[b].push_back(a);
  }
}

std::vector<int> FrameSearch::fixed() const {
  std::vector<int> open;
  for (int k = 0; k < p_.frames(); ++k)
    if (p_.fixed[k]) open.push_back(k);
  return open;
}

std::vector<int> FrameSearch::open_frames(std::vector<int> open) const {
  std::vector<double> known(p_.patches(), 0.0), saves(p_.frames(), 0.0);
  while (true) {
    context_.check();
    const Best now = best_of(open);
    update_savings(known, now.cost, saves);
    known = now.cost;
    const std::vector<double> opening = openings(open);
    const double pairs = pairs_of(open);
    double best = -1e-8;
    int add = -1, drop = -1;
    const std::vector<Addition> additions = ranked_additions(open, saves, opening);
    if (!additions.empty() && additions.front().change < best) {
      best = additions.front().change;
      add = additions.front().frame;
    }
    for (const int o : open) {
      if (p_.fixed[o] || open.size() == 1) continue;
      std::vector<int> losing;  // patches that fall back to their second best without it
      const double left_pairs = pairs - opening[o];  // irregularity(o, o) is zero
      double without = -p_.of_pairs(pairs);
      for (const Offer& offer : offers_[o])
        if (now.frame[offer.patch] == o) {
          losing.push_back(offer.patch);
          without += now.second[offer.patch] - now.cost[offer.patch];
        }
      if (const double change = without + p_.of_pairs(left_pairs); change < best) {
        best = change;
        add = -1;
        drop = o;
      }
      for (const Addition& a : additions) {
        double saves = a.saves;
        for (const int j : losing)
          saves += std::max(0.0, now.second[j] - cost_(j, a.frame)) - std::max(0.0, now.cost[j] - cost_(j, a.frame));
        const double change = without + p_.of_pairs(left_pairs + opening[a.frame] - p_.irregularity(o, a.frame)) - saves;
        if (change < best) {
          best = change;
          add = a.frame;
          drop = o;
        }
      }
    }
    if (add < 0 && drop < 0) return open;
    if (drop >= 0) std::erase(open, drop);
    if (add >= 0) open.push_back(add);
  }
}

FrameSearch::State FrameSearch::evaluate(const std::vector<int>& open, double upper) const {
  State s;
  Best now = best_of(open);
  double bound = std::accumulate(now.cost.begin(), now.cost.end(), 0.0);
  bound += p_.of_pairs(pairs_of(open));
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

FrameSearch::State FrameSearch::improve(State state) const {
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

std::vector<int> FrameSearch::promising(const std::vector<int>& open, std::size_t count) const {
  std::vector<int> result;
  std::vector<double> saves(p_.frames(), 0.0);
  update_savings(std::vector<double>(p_.patches(), 0.0), best_of(open).cost, saves);
  for (const Addition& a : ranked_additions(open, saves, openings(open)))
    if (result.size() < count) result.push_back(a.frame);
  return result;
}

FrameSearch::State FrameSearch::all_subsets(const State& state) const {
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

FrameSearch::Best FrameSearch::best_of(const std::vector<int>& open) const {
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

double FrameSearch::pairs_of(const std::vector<int>& open) const {
  double sum = 0;
  for (std::size_t a = 0; a < open.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) sum += p_.irregularity(open[a], open[b]);
  return sum;
}

std::vector<double> FrameSearch::openings(const std::vector<int>& open) const {
  std::vector<double> sum(p_.frames(), 0.0);
  for (const int o : open)
    for (int k = 0; k < p_.frames(); ++k) sum[k] += p_.irregularity(k, o);
  return sum;
}

void FrameSearch::update_savings(const std::vector<double>& known, const std::vector<double>& now, std::vector<double>& saves) const {
  for (std::size_t j = 0; j < now.size(); ++j) {
    if (known[j] == now[j]) continue;
    for (const auto& [k, cost] : offers_to_[j]) saves[k] += std::max(0.0, now[j] - cost) - std::max(0.0, known[j] - cost);
  }
}

std::vector<FrameSearch::Addition> FrameSearch::ranked_additions(const std::vector<int>& open, const std::vector<double>& saves,
                                                                 const std::vector<double>& opening) const {
  std::vector<char> is_open(p_.frames(), 0);
  for (const int k : open) is_open[k] = 1;
  std::vector<Addition> ranked;
  const double pairs = pairs_of(open), before = p_.of_pairs(pairs);
  for (int k = 0; k < p_.frames(); ++k)
    if (!is_open[k]) ranked.push_back({p_.of_pairs(pairs + opening[k]) - before - saves[k], k, saves[k]});
  const auto middle = ranked.begin() + static_cast<std::ptrdiff_t>(std::min(kSwaps, ranked.size()));
  std::partial_sort(ranked.begin(), middle, ranked.end());
  ranked.erase(middle, ranked.end());
  return ranked;
}

}  // namespace unseen::planes
