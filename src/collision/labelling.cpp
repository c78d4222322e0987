// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "collision/candidates.h"
#include "collision/chain.h"
#include "collision/flight_search.h"
#include "collision/tracks.h"
#include "collision/two_body.h"
#include "collision/which_body.h"

namespace unseen::collision {
namespace {

constexpr double kLeastRegionNoise = 0.5, kLeastSightingNoise = 0.3;  // px

/// Index of the free body beside something fixed; −1 if both are free.
int only_free_body(const Shot& shot) {
  for (std::size_t i = 0; i < shot.bodies.size(); ++i)
    if (shot.bodies[i].shape == Shape::fixed) return static_cast<int>(shot.bodies.size()) - 1 - static_cast<int>(i);
  return shot.bodies.size() < 2 ? 0 : -1;
}

Tracks label(const Shot& shot, const ShotCamera& camera, Candidates candidates, double fps, double least_noise, Context& context) {
  const int body = only_free_body(shot);
  if (body < 0) return find_pair(shot, camera, candidates, fps, least_noise, context);
  for (auto& frame : candidates) std::erase_if(frame, [&](const Candidate& c) { return c.body >= 0 && c.body != body; });
  return find_chain(shot, candidates, body, fps, least_noise, context);
}

}  // namespace

Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const Footage& footage, Context& context) {
  const bool spheres = std::all_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& b) {
    return b.shape == Shape::sphere || b.shape == Shape::fixed;
  });
  Tracks tracks = label(shot, camera, candidates_of(footage, camera, spheres), footage.fps, kLeastRegionNoise, context);
  if (only_free_body(shot) < 0) label_by_shape(shot, camera, footage, tracks);
  return tracks;
}

Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const std::vector<Sighting>& sightings, double fps, Context& context) {
  const Candidates candidates = candidates_of(sightings, camera);
  const int body = only_free_body(shot);
  if (body < 0) {
    if (std::optional<Tracks> tracks = search_pair(shot, camera, candidates, fps, kLeastSightingNoise, context)) return *tracks;
    return label(shot, camera, candidates, fps, kLeastSightingNoise, context);
  }
  Tracks tracks = label(shot, camera, candidates, fps, kLeastSightingNoise, context);
  if (tracks.meetings.empty())
    if (std::optional<Tracks> found = search_chain(shot, camera, candidates, body, fps, kLeastSightingNoise, context)) return *found;
  return tracks;
}

}  // namespace unseen::collision
