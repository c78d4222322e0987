// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "collision/tracks/candidates.h"
#include "collision/tracks/chain.h"
#include "collision/tracks/chain_search.h"
#include "collision/tracks/counting.h"
#include "collision/tracks/flight_cost.h"
#include "collision/tracks/flight_search.h"
#include "collision/tracks/tracks.h"
#include "collision/tracks/two_body.h"
#include "collision/tracks/which_body.h"

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
  return find_chain(shot, camera, candidates, body, fps, least_noise, context);
}

bool differ(const Candidates& a, const Candidates& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!std::equal(a[k].begin(), a[k].end(), b[k].begin(), b[k].end(), [](const Candidate& c, const Candidate& d) { return c.shadow == d.shadow; })) return true;
  return false;
}

/// Labels the regions of a film; where nothing collides, with more of what is dark taken for bodies.
Tracks label_regions(const Shot& shot, const ShotCamera& camera, const Footage& footage, bool spheres, Context& context) {
  const auto tracks_of = [&](const Candidates& candidates, Context& heard) {
    const Counted counted = without_repeats(candidates, footage.times, footage.fps);
    return label(shot, camera, counted.candidates, counted.rate, kLeastRegionNoise, heard);
  };
  const auto trial = [&] {
    Context quiet = context;
    quiet.on_message = {};
    (void)quiet.take_warnings();
    return quiet;
  };
  Context usual = trial(), all = trial();
  const Candidates candidates = candidates_of(footage, camera, spheres), darker = candidates_of(footage, camera, spheres, DarkBodies::all);
  Tracks tracks = tracks_of(candidates, usual);
  Context* heard = &usual;
  if (tracks.meetings.empty() && differ(candidates, darker)) {
    Tracks others = tracks_of(darker, all);
    if (!others.meetings.empty()) tracks = std::move(others), heard = &all;
  }
  for (std::string& warning : heard->take_warnings()) context.warn(std::move(warning));
  return tracks;
}

}  // namespace

Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const Footage& footage, Context& context) {
  const bool spheres = std::all_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& b) {
    return b.shape == Shape::sphere || b.shape == Shape::fixed;
  });
  Tracks tracks = label_regions(shot, camera, footage, spheres, context);
  if (only_free_body(shot) < 0) label_by_shape(shot, camera, footage, tracks);
  return tracks;
}

Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const std::vector<Sighting>& sightings, double fps, Context& context) {
  const auto [candidates, rate] = by_sightings(candidates_of(sightings, camera), fps);
  const int body = only_free_body(shot);
  if (body < 0) {
    std::optional<Tracks> tracks = search_pair(shot, camera, candidates, rate, kLeastSightingNoise, context);
    if (!tracks) tracks = label(shot, camera, candidates, rate, kLeastSightingNoise, context);
    tracks->told_apart = std::any_of(sightings.begin(), sightings.end(), [](const Sighting& s) { return s.body >= 0; });
    return *tracks;
  }
  Tracks tracks = label(shot, camera, candidates, rate, kLeastSightingNoise, context);
  if (tracks.meetings.empty()) {
    const std::vector<Candidate> seen = sightings_of(candidates, body);
    if (std::optional<Tracks> found = search_chain(shot, camera, seen, body, rate, sighting_noise({seen}, kLeastSightingNoise), context)) return *found;
  }
  return tracks;
}

}  // namespace unseen::collision
