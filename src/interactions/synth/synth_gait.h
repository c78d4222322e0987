// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "interactions/synth/synth_body.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

inline constexpr double kRate = 60;  ///< moments a second

/// What a person does at a moment, and which pieces it touches (indices; −1: none).
struct Moment {
  Posture posture;
  Action action = Action::stand;
  std::array<int, 2> touched = {-1, -1};
};
using Motion = std::vector<Moment>;

/// 0 to 1 without jerk at the ends; outside of [0,1] the nearer end.
double ease(double u);

/// A person's own way to move.
struct Manner {
  double speed = 1.0;      ///< m/s, walking
  double swing = 0.6;      ///< of arms, rad per metre between the feet
  double bend = 0.3;       ///< of elbows, rad
  double stoop = 0.05;     ///< of the trunk, rad
  double lively = 1.0;     ///< faster and wider if more
  double phase = 0;        ///< of swaying, rad
  int carrying = -1;       ///< the side of a hand that holds something before the chest; −1: none
};
Manner draw_manner(Random& random);

/// Walks from where the motion ends along a path (points on the ground) and turns to a heading at its end: feet stand where they are put
/// until they are lifted, one after the other.
void walk(Motion& motion, const Body& body, const Manner& manner, const std::vector<Vec2>& path, double final_heading);

}  // namespace unseen::interactions
