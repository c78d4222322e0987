// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/counting.h"

#include <algorithm>
#include <cmath>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

/// The candidates of each frame in the place that `place_of` gives; none = left out. `step`: frame times.
template <class PlaceOf>
Counted counted(const Candidates& candidates, double step, double fps, PlaceOf place_of) {
  Counted all{{}, fps / step};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const int place = place_of(k);
    if (place < 0) continue;
    all.candidates.resize(std::max(all.candidates.size(), static_cast<std::size_t>(place) + 1));
    for (Candidate c : candidates[k]) {
      c.number = c.frame;
      c.frame = place;
      c.u /= step;
      all.candidates[static_cast<std::size_t>(place)].push_back(c);
    }
  }
  return all;
}

}  // namespace

Counted without_repeats(const Candidates& candidates, const std::vector<double>& times, double fps) {
  std::vector<int> places;
  int own = 0;
  for (std::size_t k = 0; k < times.size(); ++k) places.push_back(k == 0 || times[k] > times[k - 1] ? own++ : -1);
  if (own < 2 || own == static_cast<int>(times.size())) return {candidates, fps};
  return counted(candidates, (times.back() - times.front()) * fps / (own - 1), fps, [&](std::size_t k) { return places[k]; });
}

Counted by_sightings(const Candidates& candidates, double fps) {
  std::vector<std::size_t> seen;
  std::vector<double> steps;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (candidates[k].empty()) continue;
    if (!seen.empty()) steps.push_back(static_cast<double>(k - seen.back()));
    seen.push_back(k);
  }
  const double step = median(std::move(steps));
  if (step < 2.0) return {candidates, fps};
  std::vector<int> places(candidates.size(), -1);
  for (std::size_t i = 0; i < seen.size(); ++i)
    places[seen[i]] = i == 0 ? static_cast<int>(std::lround(static_cast<double>(seen[0]) / step)) : places[seen[i - 1]] + std::max(1, static_cast<int>(std::lround(static_cast<double>(seen[i] - seen[i - 1]) / step)));
  return counted(candidates, step, fps, [&](std::size_t k) { return places[k]; });
}

}  // namespace unseen::collision
