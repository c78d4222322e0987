// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/movers.h"

#include <algorithm>

namespace unseen::collision {
namespace {

constexpr double kMoves = 1.0;         // diameters that a flight covers at least, and
constexpr double kMovesNoise = 8.0;    // σ
constexpr double kSameLooks = 4.0;     // σ² between looks of one body
constexpr std::size_t kMovers = 3;     // things in a film of which one is the body: the first that flies,
constexpr double kNearly = 0.3;        // if it moves by this share of what the first does

double extent(const Arc& arc) {
  Vec2 low = arc.points.front().pixel, high = low;
  for (const Candidate& c : arc.points) {
    low = low.cwiseMin(c.pixel);
    high = high.cwiseMax(c.pixel);
  }
  return (high - low).norm();
}

}  // namespace

std::vector<std::vector<Arc>> arcs_by_mover(const std::vector<Arc>& arcs, double noise) {
  std::vector<Arc> moving;
  std::vector<Candidate> looks;
  std::vector<double> worth;
  for (const Arc& arc : arcs) {
    const Candidate look = looks_of(arc);
    const double far = extent(arc);
    if (far < std::max(kMoves * look.diameter, kMovesNoise * noise)) continue;
    moving.push_back(arc);
    looks.push_back(look);
    worth.push_back(look.round * (static_cast<double>(arc.points.size()) - 3.0) * std::min(1.0, far / std::max(1.0, 3.0 * look.diameter)));
  }
  std::vector<std::vector<Arc>> movers;
  std::vector<char> taken(moving.size(), 0);
  for (double first = 0.0; movers.size() < kMovers;) {
    double most = kNearly * first;
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if (taken[i]) continue;
      double sum = 0.0;
      std::vector<std::size_t> alike;
      for (std::size_t j = 0; j < moving.size(); ++j)
        if (!taken[j] && unlikeness(looks[i], looks[j]) < kSameLooks) {
          sum += worth[j];
          alike.push_back(j);
        }
      if (sum > most) {
        most = sum;
        best = std::move(alike);
      }
    }
    if (best.empty()) break;
    if (movers.empty()) first = most;
    std::vector<Arc>& mover = movers.emplace_back();
    for (const std::size_t i : best) mover.push_back(moving[i]), taken[i] = 1;
  }
  return movers;
}

}  // namespace unseen::collision
