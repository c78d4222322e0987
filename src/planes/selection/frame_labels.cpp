// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "planes/selection/frame_search.h"

// The labels of the patches, with the frames given.
namespace unseen::planes {

double FrameSearch::total(const std::vector<int>& open, const Labels& labels) const {
  double sum = p_.of_pairs(pairs_of(open));
  for (int j = 0; j < p_.patches(); ++j) sum += cost_(j, labels[j]);
  for (const auto& [a, b] : p_.neighbours) sum += differs(a, labels[a], b, labels[b]);
  return sum;
}

void FrameSearch::relax(const std::vector<int>& open, Labels& labels) const {
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

bool FrameSearch::move(std::span<const int> part, const std::vector<int>& open, std::vector<char>& inside, Labels& labels) const {
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

std::vector<std::vector<int>> FrameSearch::parts(const Labels& labels) const {
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

}  // namespace unseen::planes
