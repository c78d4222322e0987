// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Frames in which somebody was detected; others say nothing of anybody and do not count.
struct Sightings {
  std::vector<int> frames;                     ///< ascending
  std::vector<std::vector<int>> at;            ///< detections (indices into the take) of each of those frames
  std::vector<int> slot;                       ///< of each detection, its place in `frames`
  std::vector<std::optional<Vec2>> before, after;  ///< px / frame of each detection, from those before and after it that are surely the same person
  double half_diagonal = 0;                    ///< px
  int memory = 0;                              ///< slots after which it is forgotten where somebody was
};

Sightings sightings_of(const Take& take);

constexpr double kAbsent = 1.0;   ///< of a person in a frame without a detection (Eq. 6.14)
constexpr double kLeave = 20.0;   ///< of leaving when seen well, and of coming back so
constexpr double kMissed = 2.0;   ///< of a frame missed between two detections
constexpr double kMotion = 1e3;   ///< weight of motion (Eq. 6.16)
constexpr double kMotionFps = 10; ///< 1/s; people move farther from frame to frame of slower takes, which costs no more

/// Of a person at a detection: minus the mean confidence of its joints (Eq. 6.14).
double presence_cost(const Detection& detection);

/// Of leaving after a detection, or coming back at it: squared mean confidence × kLeave, for people fade before they are hidden. Without it two
/// people would take turns at the detections of one while the other is hidden.
double leave_cost(const Detection& detection);

/// Of a person at two detections of different frames and none between: the mean over joints of confidence-weighted squared motion in half
/// diagonals of the image (Eq. 6.15), over the number of frames between, plus the frames missed: each costs kAbsent + kMissed, or together
/// leaving and coming back if that is less. Motion is what the velocity before the one does not explain, or the velocity after the other,
/// whichever explains more: people who cross would otherwise seem to turn back. A joint that jumps alone counts as three times the median,
/// and left may be right in one of them, as detectors err so.
double link_cost(const Take& take, const Sightings& sightings, int from, int to);

/// Of a person's whole path, given as its detections by frame: the model that identify() minimises.
double path_cost(const Take& take, const Sightings& sightings, const std::vector<int>& path);

}  // namespace unseen::interactions
