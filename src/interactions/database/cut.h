// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

constexpr double kFarthest = 1000;  ///< m; what lies farther is in another unit

/// One person without a long gap: a pose for every frame from the first on.
struct Track {
  int first_frame = 0;
  std::vector<Pose> poses;
  std::vector<bool> valid;  ///< recorded; others are interpolated
  std::vector<Action> actions;
};

/// Fills gaps of at most half a second and splits at longer ones. Throws InputError (`source`) for frames out of order or poses that are not finite.
std::vector<Track> tracks_of(const std::vector<RecordedFrame>& frames, double fps, const std::string& source);

/// Ten moving averages, each over 1 cm of path to either side (thesis Section 6.2.1.1).
std::vector<Vec3> smoothed(std::vector<Vec3> path);

/// Poses of a track that make a scenelet, the last one included.
struct Clip {
  int first = 0, middle = 0, last = 0;
};

/// Clips around places a step of the smoothed pelvis path apart, and a second apart where it stands still. Each covers the arc length or,
/// on either side, half the longest time; those that the track's ends would shorten are left out.
std::vector<Clip> cut(const Track& track, double fps, const SceneletOptions& options);

}  // namespace unseen::interactions
