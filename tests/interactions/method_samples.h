// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "interactions/matching/matching.h"
#include "unseen/interactions/synth.h"

// Generated takes as the stages of the method see them.
namespace unseen::interactions::test {

inline SynthOptions synth_options(int seed, double seconds = 40, int people = 1) {
  SynthOptions options;
  options.seed = seed;
  options.seconds = seconds;
  options.people = people;
  return options;
}

/// The take with the true identities, as if these had been told.
inline Take with_persons(Take take) {
  for (Detection& d : take.detections) d.person = std::max(d.person, 0);
  return take;
}

inline View true_view(const SynthTake& synth) { return {synth.take.camera, synth.truth.T_world_camera}; }

/// Scenelets of a few generated recordings; `first` is the first one's seed.
inline Database small_database(int first, int recordings, double seconds = 20) {
  std::vector<Recording> all;
  for (int i = 0; i < recordings; ++i) {
    all.push_back(simulate(synth_options(first + i, seconds)).truth);
    all.back().name += std::to_string(i);
  }
  Context context;
  return build_database(all, {}, context);
}

/// A scenelet of one second whose pelvis moves along +x at `speed` (m/s) and is over its origin at the middle, in this pose.
inline Scenelet moving_scenelet(const Pose& pose, double speed, const std::vector<Object>& objects = {}) {
  Scenelet s;
  s.middle = 5;
  for (int i = -5; i <= 5; ++i) {
    s.poses.push_back(pose.colwise() + Vec3(speed * i / s.fps, 0, 0));
    s.actions.push_back(Action::stand);
    s.valid.push_back(true);
  }
  s.objects = objects;
  return s;
}

}  // namespace unseen::interactions::test
