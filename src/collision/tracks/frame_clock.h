// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <map>

#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// Between decoded frames and the time that went by: the same thing, but for clips that lost frames.
class FrameClock {
 public:
  FrameClock(const Tracks& tracks, double fps);

  double frame_at(double time) const;
  double time_at(double frame) const;
  /// The frames that any flight spans.
  int first() const { return first_; }
  int last() const { return last_; }

 private:
  std::map<double, double> time_of_, frame_of_;
  double fps_;
  int first_ = 0, last_ = -1;
};

}  // namespace unseen::collision
