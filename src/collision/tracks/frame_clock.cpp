// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/frame_clock.h"

#include <iterator>

namespace unseen::collision {
namespace {

/// Piecewise linear through the table; at its ends goes on with `slope`.
double interpolated(const std::map<double, double>& table, double x, double slope) {
  if (table.empty()) return x * slope;
  const auto above = table.lower_bound(x);
  if (above == table.end()) return std::prev(above)->second + (x - std::prev(above)->first) * slope;
  if (above == table.begin()) return above->second + (x - above->first) * slope;
  const auto below = std::prev(above);
  return below->second + (above->second - below->second) * (x - below->first) / (above->first - below->first);
}

}  // namespace

FrameClock::FrameClock(const Tracks& tracks, double fps) : fps_(fps) {
  for (const TrackPoint& p : tracks.points) {
    time_of_[p.frame] = p.time - p.rolled;
    frame_of_[p.time - p.rolled] = p.frame;
  }
  if (time_of_.empty()) return;
  first_ = static_cast<int>(time_of_.begin()->first);
  last_ = static_cast<int>(time_of_.rbegin()->first);
}

double FrameClock::frame_at(double time) const { return interpolated(frame_of_, time, fps_); }
double FrameClock::time_at(double frame) const { return interpolated(time_of_, frame, 1.0 / fps_); }

}  // namespace unseen::collision
