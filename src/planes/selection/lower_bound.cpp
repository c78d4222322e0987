// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "planes/selection/selection.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kWork = 8'000'000;  // candidates looked at, over all nodes

/// A subproblem: the first `decided` frames of the branching order are open or closed.
struct Node {
  double bound = 0;
  double data = 0, pairs = 0;  // the least with all frames that are not closed; irregularities of those that are open
  std::size_t decided = 0;
  std::vector<char> state;  // per frame: 0 undecided, 1 open, 2 closed
  bool operator<(const Node& o) const { return bound > o.bound; }  // smallest bound on top
};

/// What frames offer a patch: cost and frame, the least first.
using Ranked = std::vector<std::pair<double, int>>;

std::vector<Ranked> ranked_offers(const SelectionProblem& p) {
  std::vector<Ranked> ranked(p.patches());
  const Offers offers = offers_of(p);
  for (int k = 0; k < p.frames(); ++k)
    for (const Offer& o : offers[k]) ranked[o.patch].emplace_back(o.cost, k);
  for (Ranked& of_patch : ranked) std::sort(of_patch.begin(), of_patch.end());
  return ranked;
}

double least_data(const std::vector<Ranked>& offers, const std::vector<char>& state) {
  double sum = 0;
  for (const Ranked& of_patch : offers) {
    const auto least = std::find_if(of_patch.begin(), of_patch.end(), [&](const auto& offer) { return state[offer.second] != 2; });
    sum += least == of_patch.end() ? std::numeric_limits<double>::infinity() : least->first;
  }
  return sum;
}

/// Irregularity between a frame and those that are open.
double irregularity_with(const SelectionProblem& p, int frame, const std::vector<char>& state) {
  double sum = 0;
  for (int k = 0; k < p.frames(); ++k)
    if (state[k] == 1) sum += p.irregularity(k, frame);
  return sum;
}

}  // namespace

double lower_bound(const SelectionProblem& p, double upper, const Context& context) {
  if (p.patches() == 0) return energy_of(p, {}).total();
  const std::vector<Ranked> offers = ranked_offers(p);
  // Branch first on the frames that matter most: those whose absence costs the most data.
  std::vector<double> weight(p.frames(), 0.0);
  for (int j = 0; j < p.patches(); ++j) {
    double first = 1e9, second = 1e9;
    int who = -1;
    for (int k = 0; k < p.frames(); ++k) {
      const double d = std::min(p.data(j, k), 1e9);
      if (d < first) {
        second = first;
        first = d;
        who = k;
      } else {
        second = std::min(second, d);
      }
    }
    if (who >= 0) weight[who] += second - first;
  }
  std::vector<int> order;
  Node root;
  root.state.assign(p.frames(), 0);
  for (int k = 0; k < p.frames(); ++k) {
    if (p.fixed[k]) {
      root.pairs += irregularity_with(p, k, root.state);
      root.state[k] = 1;
    } else {
      order.push_back(k);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weight[a] > weight[b]; });
  root.data = least_data(offers, root.state);
  root.bound = root.data + p.of_pairs(root.pairs);
  std::priority_queue<Node> open;
  open.push(root);
  const std::size_t nodes = kWork / (1 + static_cast<std::size_t>(p.patches()) * p.frames());
  for (std::size_t n = 0; n < nodes && !open.empty(); ++n) {
    if ((n & 63) == 0) context.check();
    const Node node = open.top();
    if (node.bound >= upper || node.decided == order.size()) break;
    open.pop();
    for (const char state : {char{1}, char{2}}) {
      Node child = node;
      const int frame = order[child.decided++];
      child.state[frame] = state;
      if (state == 1) {
        child.pairs += irregularity_with(p, frame, node.state);
      } else {
        child.data = least_data(offers, child.state);
      }
      child.bound = std::max(node.bound, child.data + p.of_pairs(child.pairs));
      if (child.bound < upper) open.push(std::move(child));
    }
  }
  return open.empty() ? upper : std::min(upper, open.top().bound);
}

}  // namespace unseen::planes
