// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/rolling_shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "unseen/core/error.h"

namespace unseen::collision {

double row_share(const Vec2& pixel, const Camera& camera, int turn) {
  const double x = (pixel.x() + 0.5) / camera.width - 0.5, y = (pixel.y() + 0.5) / camera.height - 0.5;
  return turn == 90 ? -x : turn == 180 ? -y : turn == 270 ? x : y;
}

void check_readout(const Shot& shot, const Footage& footage, double fps) {
  constexpr double kSlack = 1.02;  // rounded frame rates
  const double readout = shot.camera.readout.value_or(0.0), repeats = static_cast<double>(std::count(footage.doubled.begin(), footage.doubled.end(), 1));
  const double lasts = 1.0 / (footage.doubled.empty() ? fps : fps * (1.0 - repeats / static_cast<double>(footage.doubled.size())));
  if (!(std::abs(readout) <= kSlack * lasts))
    throw InputError(shot.name, "camera.readout", fmt::format("{} s", readout), fmt::format("at most what a frame lasts, {:.4f} s", lasts));
}

Tracks with_rolling_shutter(Tracks tracks, const ShotCamera& camera, int turn) {
  for (TrackPoint& p : tracks.points) {
    p.row = row_share(p.pixel, camera.camera, turn);
    p.rolled = camera.readout.value_or(0.0) * p.row;
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
