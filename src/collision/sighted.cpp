// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/sighted.h"

#include <algorithm>
#include <map>

namespace unseen::collision {

std::vector<Sighted> sighted_in(const Footage& footage, const Tracks& tracks) {
  constexpr std::size_t kMost = 8, kMostOfAll = 20'000;  // of a frame, of a long clip
  const std::size_t most = std::clamp<std::size_t>(kMostOfAll / std::max<std::size_t>(footage.regions.size(), 1), 1, kMost);
  std::map<std::array<int, 2>, int> body_of;  // by frame and region
  for (const FlightSpan& span : tracks.spans)
    for (std::size_t i = span.begin; i < span.end; ++i) body_of[{tracks.points[i].frame, tracks.points[i].region}] = span.body;
  std::vector<Sighted> all;
  for (std::size_t f = 0; f < footage.regions.size(); ++f) {
    std::size_t others = 0;
    for (std::size_t i = 0; i < footage.regions[f].size(); ++i) {
      const Region& region = footage.regions[f][i];
      const auto in_flight = body_of.find({static_cast<int>(f), static_cast<int>(i)});
      if (in_flight == body_of.end() && (region.shadow || ++others > most)) continue;
      all.push_back({static_cast<int>(f), in_flight == body_of.end() ? std::nullopt : std::optional(in_flight->second), region.centroid, region.diameter});
    }
  }
  return all;
}

}  // namespace unseen::collision
