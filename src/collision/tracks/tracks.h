// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/video/regions.h"
#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// A body's centre at one time, ready for the solver.
struct TrackPoint {
  int body = 0;
  int frame = 0;
  double time = 0;                ///< s
  Vec2 pixel = Vec2::Zero();      ///< without lens distortion
  double diameter = 0;            ///< projected, px; 0 = unknown
  int region = -1;                ///< index into Footage::regions[frame]; −1 = none
  double row = 0;                 ///< share of a rolling shutter's readout, −½ to ½, after which its row was read
  double rolled = 0;              ///< s of the time, for that
};

/// A time span in which a body flies freely. Point indices [begin, end) into Tracks::points.
struct FlightSpan {
  int body = 0;
  std::size_t begin = 0, end = 0;
};

/// Which sightings belong to which flight, and when the flights meet.
/// Two free bodies: each has at most two spans, before and after the one impact. One body and something fixed: a chain of
/// spans of body 0; an impact joins two neighbours if their extrapolations meet between them.
struct Tracks {
  std::vector<TrackPoint> points;   ///< by span, in time order
  std::vector<FlightSpan> spans;    ///< in time order
  struct Meeting {
    double time = 0;                ///< s, first guess
    std::vector<int> before, after;  ///< spans that end (begin) there: one a body
  };
  std::vector<Meeting> meetings;
  double noise = 1.0;               ///< px, robust σ of the points about their spans' curves
  bool told_apart = false;          ///< by labels or their shapes: two free bodies cannot have been taken for each other
  int collisions_seen = 0;          ///< more than one for two free bodies: the shot has several collisions
};

/// Takes each of two free bodies for the other.
inline void exchange_bodies(Tracks& tracks) {
  for (FlightSpan& span : tracks.spans) span.body = 1 - span.body;
  for (TrackPoint& point : tracks.points) point.body = 1 - point.body;
}

/// Tracks from the regions of a video, or from sightings. `camera` carries the image size; intrinsics are complete.
Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const Footage& footage, Context& context);
Tracks find_tracks(const Shot& shot, const ShotCamera& camera, const std::vector<Sighting>& sightings, double fps, Context& context);

}  // namespace unseen::collision
