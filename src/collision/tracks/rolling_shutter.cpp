// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/rolling_shutter.h"

#include <fmt/format.h>

#include <cmath>

#include "unseen/core/error.h"

namespace unseen::collision {

double row_share(double row, int height) { return (row + 0.5) / height - 0.5; }

void check_readout(const Shot& shot, double fps) {
  constexpr double kSlack = 1.02;  // rounded frame rates
  const double readout = shot.camera.readout.value_or(0.0);
  if (!(std::abs(readout) <= kSlack / fps))
    throw InputError(shot.name, "camera.readout", fmt::format("{} s", readout), fmt::format("at most what a frame lasts, {:.4f} s", 1.0 / fps));
}

Tracks with_rolling_shutter(Tracks tracks, const ShotCamera& camera) {
  const double readout = camera.readout.value_or(0.0);
  if (readout == 0.0) return tracks;
  for (TrackPoint& p : tracks.points) {
    p.rolled = readout * row_share(p.pixel.y(), camera.camera.height);
    p.time += p.rolled;
  }
  for (Tracks::Meeting& meeting : tracks.meetings) {
    double rolled = 0.0;
    for (const int s : meeting.before) rolled += tracks.points[tracks.spans[static_cast<std::size_t>(s)].end - 1].rolled;
    for (const int s : meeting.after) rolled += tracks.points[tracks.spans[static_cast<std::size_t>(s)].begin].rolled;
    meeting.time += rolled / static_cast<double>(meeting.before.size() + meeting.after.size());
  }
  return tracks;
}

}  // namespace unseen::collision
