// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "collision/tracks/arcs.h"

namespace unseen::collision {

constexpr double kLooksAlike = 6.0;  ///< σ² between neighbours' looks

/// Whether a candidate can be a body alone.
bool can_fly(const Candidate& c);

/// Grows arcs from seeds, frame by frame, as find_arcs says.
class ArcGrower {
 public:
  ArcGrower(const Candidates& candidates, double noise, double jitter);

  /// From three candidates, `step` frames apart from `first` on; none where too few follow.
  std::optional<Arc> grow(int first, int step, const Candidate& a, const Candidate& b, const Candidate& c);

 private:
  void add(const Candidate& c);
  void extend(int k, int direction);
  void grow_again();
  void drop_strays();
  std::vector<const Candidate*> at_end(int direction) const;
  bool led_to(const Candidate& next, const Curve& curve, int direction) const;
  const Candidate* nearest(int k, const Curve& curve, const Candidate& like, double variance) const;

  const Candidates& candidates_;
  double noise_, jitter_;  ///< px; no jitter = neighbours tell no more than the curve
  std::map<int, Candidate> points_;
  CurveSums sums_{0.0};
};

}  // namespace unseen::collision
