// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "interactions/ground/sight.h"

namespace unseen::interactions {

// What upright bodies are like, and how sure of it one may be, for those who read a floor from them.
inline constexpr double kAnkleHeight = 0.13;                // m, of the joint that detectors mark
inline constexpr double kTorso = 0.44, kLeg = 0.77;         // m, shoulders to hips and hip to ankle of an adult of 1.7 m
inline constexpr double kPoseSd = 0.05, kStatureSd = 0.06;  // of a length in the picture, as a share: who leans, and who is tall
inline constexpr double kRough = 1.5;                       // sd beyond which a body counts less and less
inline constexpr double kCorrelated = 0.5;                  // s that one stance lasts
inline constexpr double kKnownSd = 1e-4;                    // of what the take gives

/// Someone upright in the picture: the lengths of the torso (middle of the shoulders to that of the hips) and of the leg with the lower ankle,
/// and that ankle's row, px.
struct Upright {
  double torso, leg, ankle;
};

/// Nothing if the torso is not seen, or no leg that is stretched.
std::optional<Upright> upright_body(const Detection& d);

}  // namespace unseen::interactions
