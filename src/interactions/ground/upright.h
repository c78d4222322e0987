// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "interactions/ground/sight.h"

namespace unseen::interactions {

// What upright bodies are like, and how sure of it one may be, for those who read a floor from them.
inline constexpr double kAnkleHeight = 0.13;  // m, of the joint that detectors mark
inline constexpr double kTorso = 0.44,
                        kLeg = 0.77;        // m, shoulders to hips and hip to ankle of an adult of 1.7 m
inline constexpr double kStatureSd = 0.06;  // of a length, as a share: who is tall
inline constexpr double kRough = 1.5;       // sd beyond which a body counts less and less
inline constexpr double kCorrelated = 0.5;  // s that one stance lasts

struct Leg {
  Joint shoulder, hip, knee, ankle;  ///< of one side
};
inline constexpr Leg kLegs[] = {{right_shoulder, right_hip, right_knee, right_ankle},
                                {left_shoulder, left_hip, left_knee, left_ankle}};

/// From the middle of the shoulders to that of the hips, px; 0 if one is not seen.
double torso_length(const Detection& d);

/// How long an upright thigh and shin look, as shares of the torso above them.
struct LegShares {
  double thigh = 0.84, shin = 0.91;  // in a level view
};

/// Is the leg seen, and does it stand upright under a torso of this length (px)? Who sits or bends is not as
/// tall as who stands.
bool is_stretched(const Detection& d, const Leg& leg, double torso, const LegShares& upright = {});

/// The detection as a camera that is not rolled has it: turned about the principal point by `roll` (rad).
Detection levelled(Detection d, const Camera& camera, double roll);

/// Somebody who stands or walks, in the picture of a focal length of one. Each point is the middle of two
/// joints, or those of the one side whose foot is seen.
struct Upright {
  Vec2 ankle, hip, shoulder;
  int person = 0, frame = 0;
  double weight = 1;  ///< how many independent looks at this body it stands for

  double length() const { return (shoulder - ankle).norm(); }
};

/// A camera over a floor by its height above ankles (as a logarithm, of m), pitch and roll (rad), in this
/// order.
struct FloorBelief {
  Vec3 mean = Vec3::Zero();
  Mat3 covariance = Mat3::Identity();
};

/// Of all detections that have a person, both feet or a leg that is stretched, by frame; a pose that lasts
/// counts little more than one that does not. If a camera is `seen_by`, only those who stand or walk, as it
/// sees the length of upright legs.
std::vector<Upright> upright_bodies(const Take& take, const FloorBelief* seen_by);

}  // namespace unseen::interactions
